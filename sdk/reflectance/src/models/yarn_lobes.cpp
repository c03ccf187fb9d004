#include "tsuya/sdk/yarn_lobes.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "models/slope_lobes.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr double kStep = 2 * kDegree;
constexpr int kMiddle = kYarnSlopes / 2;

} // namespace

double yarn_slope(int k) { return (k - kMiddle) * kStep; }

double YarnLobes::filaments(std::size_t axis) const {
    return std::accumulate(surface[axis].begin(), surface[axis].end(), 0.0);
}

double YarnLobes::weft_share() const {
    const double weft = filaments(0), both = weft + filaments(1);
    return both > 0 ? weft / both : 0.5;
}

std::array<double, kYarnSlopes> YarnLobes::depth(std::size_t axis) const {
    std::array<double, kYarnSlopes> made{};
    double climbed = 0;
    for (int k = 0; k <= kMiddle; ++k) {
        const auto up = static_cast<std::size_t>(kMiddle + k),
                   down = static_cast<std::size_t>(kMiddle - k);
        const double both = surface[axis][up] + (k > 0 ? surface[axis][down] : 0);
        const double rise = std::tan(k * kStep) * both;
        made[up] = made[down] = climbed + 0.5 * rise;
        climbed += rise;
    }
    for (double &d : made)
        d *= climbed > 0 ? dive / climbed : 0;
    return made;
}

double yarn_lobe(int axis, double slope, double roughness, const glm::dvec3 &half) {
    return yarn_lobe(half[axis] * std::cos(slope) + half.z * std::sin(slope), roughness);
}

double yarn_lobe(double sine, double roughness) {
    const double angle = std::asin(std::clamp(sine, -1.0, 1.0)) / roughness;
    return std::exp(-0.5 * angle * angle) / (std::sqrt(2 * kPi) * roughness * kPi);
}

double yarn_facets(const YarnLobes &lobes, int axis, const glm::dvec3 &half) {
    return SlopeLobes(lobes.roughness)
        .of_system(lobes, static_cast<std::size_t>(axis), half[axis], half.z);
}

} // namespace tsuya

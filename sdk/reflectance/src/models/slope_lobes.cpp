#include "models/slope_lobes.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

constexpr double kFarthest = 8;   // in standard deviations: beyond, a lobe has 1e-14 of its peak
constexpr double kCoarsest = 1.2; // distance of parts in roughnesses: their sum is even to 1e-5
constexpr int kLeastParts = 2;

} // namespace

SlopeLobes::SlopeLobes(double roughness) {
    const double step = yarn_slope(1) - yarn_slope(0);
    const int m =
        std::max(kLeastParts, static_cast<int>(std::ceil(step / (kCoarsest * roughness))));
    // Of the variance of the hat, step^2 / 6, parts at j / m have (1 - 1/m^2)
    width_ = std::sqrt(roughness * roughness + step * step / (6.0 * m * m));
    farthest_ = std::sin(std::min(kFarthest * width_, 0.5 * kPi));
    parts_ = 2 * m - 1;
    for (int k = 0; k < kYarnSlopes; ++k)
        for (int j = 1 - m; j < m; ++j) {
            const double slope = yarn_slope(k) + step * j / m;
            part_.push_back(
                {std::cos(slope), std::sin(slope), (1 - std::abs(j) / static_cast<double>(m)) / m});
        }
}

double SlopeLobes::at(int k, double along, double up) const {
    double sum = 0;
    const Part *const part = &part_[static_cast<std::size_t>(k * parts_)];
    for (int i = 0; i < parts_; ++i)
        if (const double sine = along * part[i].cosine + up * part[i].sine;
            std::abs(sine) <= farthest_)
            sum += part[i].share * yarn_lobe(sine, width_);
    return sum;
}

double SlopeLobes::of_system(const YarnLobes &lobes, std::size_t axis, double along,
                             double up) const {
    double sum = 0;
    for (int k = 0; k < kYarnSlopes; ++k)
        if (const double s = lobes.surface[axis][static_cast<std::size_t>(k)]; s > 0)
            sum += s * at(k, along, up);
    return sum;
}

} // namespace tsuya

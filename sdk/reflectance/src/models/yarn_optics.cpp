#include "tsuya/sdk/detail/yarn_optics.h"

#include <algorithm>
#include <cmath>

#include "models/slope_lobes.h"

namespace tsuya {
namespace {

// Of all cloths alike; found on five weaves, see sdk/docs/REFLECTANCE_STUDY.md
constexpr double kFlank = 0.35;        // of the filaments of a yarn
constexpr double kSecond = 0.6;        // light that meets a second filament, of what meets one
constexpr double kSecondCosine = 0.75; // mean cosine of both meetings, in the plane across
constexpr double kLeastFacets = 1e-9;  // 1/sr
constexpr double kLargestIndex = 1000; // stands for f0 = 1

// [Walter] Eq. 22
double dielectric(double cosine, double index) {
    const double c = std::clamp(cosine, 1e-9, 1.0);
    const double g = std::sqrt(index * index - 1 + c * c);
    const double s = (g - c) / (g + c), p = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * s * s * (1 + p * p);
}

// What the roughness of a filament hides from a light and a viewer who stand at this cosine from
// the normal on opposite sides: 1 / (1 + 2 Lambda), [Heitz] Eqs. 72 and 99, of slopes with the
// variance of the filament's.
double masking(double cosine, double roughness) {
    const double sine2 = 1 - cosine * cosine, alpha2 = 2 * roughness * roughness;
    return cosine / std::sqrt(std::max(cosine * cosine + alpha2 * sine2, 1e-20));
}

// One table for all, made when it is first needed.
const FilamentBed &bed_of_all() {
    static const FilamentBed bed(kFlank);
    return bed;
}

} // namespace

YarnOptics::YarnOptics(double f0, double roughness) : bed_(&bed_of_all()) {
    const double root = std::sqrt(f0);
    const double index = std::min((1 + root) / std::max(1 - root, 1e-9), kLargestIndex);
    for (std::size_t i = 0; i < kNodes; ++i) {
        const double x = static_cast<double>(i) / (kNodes - 1);
        const double twice = dielectric(kSecondCosine * std::sqrt(1 - x), index);
        fresnel_[i] = static_cast<float>(dielectric(x, index) * masking(x, roughness));
        second_[i] = static_cast<float>(kSecond * twice * twice);
    }
}

YarnDive::YarnDive(const YarnLobes &lobes, std::size_t axis)
    : all_(static_cast<float>(lobes.dive)) {
    const std::array<double, kYarnSlopes> depth = lobes.depth(axis);
    YarnLobes deep = lobes;
    for (std::size_t k = 0; k < depth.size(); ++k)
        deep.surface[axis][k] *= depth[k];
    const SlopeLobes shapes(lobes.roughness);
    double before = 0; // where there are no filaments it goes on
    for (int i = 0; i < kNodes; ++i) {
        const double x = std::min(static_cast<double>(i) / (kNodes - 2), 1.0);
        const glm::dvec2 part = glm::normalize(glm::dvec2(x, 1 - x));
        const auto both = [&](const YarnLobes &of) {
            return shapes.of_system(of, axis, part.x, part.y) +
                   shapes.of_system(of, axis, -part.x, part.y);
        };
        if (const double all = both(lobes); lobes.dive > 0 && all > kLeastFacets)
            before = both(deep) / all;
        depth_[static_cast<std::size_t>(i)] = static_cast<float>(before);
    }
}

} // namespace tsuya

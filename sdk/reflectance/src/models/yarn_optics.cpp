#include "tsuya/sdk/detail/yarn_optics.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

// Of all cloths alike; found on five weaves, see sdk/docs/REFLECTANCE_STUDY.md
constexpr double kFlank = 0.35;        // of the filaments of a yarn
constexpr double kSecond = 0.6;        // light that meets a second filament, of what meets one
constexpr double kSecondCosine = 0.75; // mean cosine of both meetings, in the plane across
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

} // namespace tsuya

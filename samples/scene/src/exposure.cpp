#include "tsuya/scene/exposure.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "tsuya/color/relight.h"
#include "tsuya/color/srgb.h"
#include "tsuya/scene/own_lamps.h"

namespace tsuya::scene {
namespace {

// The rule, see the header.
constexpr double kBrightCode = 235, kBrightShare = 0.9;
constexpr double kClippedCode = 254.5, kUnclippedShare = 0.99;
// A pixel that the garment fills, but for rounding.
constexpr float kFilled = 0.999f;

/// Scene light that a view shows as a code of 255.
double light_of(double code, const std::string &view) {
    const double shown = srgb_decode(code / 255);
    if (view != "Soft")
        return shown;
    double low = 0, high = 1e6;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (soft_shoulder(middle) < shown ? low : high) = middle;
    }
    return low;
}

/// The value that a share of the others does not exceed; nearest rank.
double percentile(std::vector<double> &values, double share) {
    const auto rank =
        static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(values.size()))) - 1;
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

} // namespace

ExposureMeter::ExposureMeter(const DisplayOptions &look) : look_(look) {
    check_display_options(look);
    bright_ = light_of(kBrightCode, look.view);
    clipped_ = light_of(kClippedCode, look.view);
}

void ExposureMeter::add(const SpectralImage &transport, std::span<const NamedLamp> lamps) {
    const Lighting lighting = lighting_of_picture(transport, lamps);
    const Image xyz = relight(transport, lighting);
    const glm::dmat3 adapt = adaptation_matrix(look_.adapt, adopted_white(transport, lighting),
                                               srgb_white(), look_.degree);
    const Image *const coverage = garment_coverage(transport);
    std::vector<double> luminances, channels;
    for (int y = 0; y < xyz.height; ++y)
        for (int x = 0; x < xyz.width; ++x) {
            const float *const v = xyz.pixel(x, y);
            const glm::dvec3 seen = adapt * glm::dvec3(v[0], v[1], v[2]);
            if (!(seen.y > 0) || (coverage && *coverage->pixel(x, y) < kFilled))
                continue;
            const glm::dvec3 rgb = srgb_from_xyz() * seen;
            luminances.push_back(seen.y);
            channels.push_back(std::max({rgb.x, rgb.y, rgb.z}));
        }
    if (luminances.empty())
        return;
    const double stops = std::log2(std::min(bright_ / percentile(luminances, kBrightShare),
                                            clipped_ / percentile(channels, kUnclippedShare)));
    stops_ = std::min(stops_.value_or(stops), stops);
}

double ExposureMeter::stops() const { return std::clamp(stops_.value_or(0), -20.0, 20.0); }

} // namespace tsuya::scene

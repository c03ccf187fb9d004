#include "tsuya/color/color_temperature.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "planck.h"
#include "tsuya/color/observer.h"

namespace tsuya {
namespace {

constexpr double kC2NmK = 1.4388e7;
constexpr double kColdest = 1000, kHottest = 100'000;
constexpr double kFarthest = 0.05;

// [CIE015] CIE 1960 uniform-chromaticity-scale diagram.
glm::dvec2 uv_of(const glm::dvec2 &xy) {
    const double scale = 1 / (-2 * xy.x + 12 * xy.y + 3);
    return {4 * xy.x * scale, 6 * xy.y * scale};
}

/// Chromaticity of a black body of `mired` = 1e6 K / temperature.
glm::dvec2 locus(double mired) {
    glm::dvec3 sum(0.0);
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm)
        sum += planck(nm, kC2NmK * mired * 1e-6) * color_matching(Observer::cie1931, nm);
    return uv_of(chromaticity(sum));
}

} // namespace

double planck(double nm, double c2_over_kelvin_nm) {
    return 100 * std::pow(560 / nm, 5) * std::expm1(c2_over_kelvin_nm / 560) /
           std::expm1(c2_over_kelvin_nm / nm);
}

Spectrum planck_spectrum(double c2_over_kelvin_nm) {
    Spectrum s{{}, {}};
    for (int nm = kObserverFirstNm; nm <= kObserverLastNm; ++nm) {
        s.wavelength_nm.push_back(nm);
        s.value.push_back(planck(nm, c2_over_kelvin_nm));
    }
    return s;
}

Spectrum black_body(double kelvin) { return planck_spectrum(kC2NmK / kelvin); }

std::optional<ColorTemperature> color_temperature(const glm::dvec2 &xy) {
    const glm::dvec2 uv = uv_of(xy);
    const auto distance = [&](double mired) { return glm::distance(uv, locus(mired)); };
    // The nearest of a row of temperatures, then the minimum about it by golden sections.
    constexpr int kSteps = 50;
    const double low = 1e6 / kHottest, high = 1e6 / kColdest;
    const double ratio = std::pow(high / low, 1.0 / kSteps);
    double best = low, least = distance(low);
    for (double mired = low * ratio; mired < high * ratio; mired *= ratio)
        if (const double d = distance(mired); d < least) {
            least = d;
            best = mired;
        }
    constexpr double kGolden = 0.6180339887498949, kTolerance = 1e-7;
    double from = best / ratio, to = best * ratio;
    double left = to - kGolden * (to - from), right = from + kGolden * (to - from);
    double at_left = distance(left), at_right = distance(right);
    while (to - from > kTolerance * to)
        if (at_left < at_right) {
            to = right;
            right = left;
            at_right = at_left;
            left = to - kGolden * (to - from);
            at_left = distance(left);
        } else {
            from = left;
            left = right;
            at_left = at_right;
            right = from + kGolden * (to - from);
            at_right = distance(right);
        }
    const double mired = (from + to) / 2, found = distance(mired);
    if (!(found <= kFarthest) || mired <= low || mired >= high)
        return std::nullopt;
    return ColorTemperature{1e6 / mired, uv.y < locus(mired).y ? -found : found};
}

} // namespace tsuya

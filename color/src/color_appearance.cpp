#include "color_appearance.h"

#include <cmath>

#include <glm/matrix.hpp>

#include "tsuya/color/adaptation.h"

namespace tsuya {
namespace {

// [CIE224] section 4.5: viewing conditions, and what [CIE159] makes of them.
constexpr double kAdaptingLuminance = 100, kBackground = 20, kWhiteY = 100;
constexpr double kSurround = 0.69;
constexpr double kN = kBackground / kWhiteY;

double luminance_factor() {
    const double k = 1 / (5 * kAdaptingLuminance + 1), k4 = k * k * k * k;
    return 0.2 * k4 * 5 * kAdaptingLuminance +
           0.1 * (1 - k4) * (1 - k4) * std::cbrt(5 * kAdaptingLuminance);
}

// [CIE159] Eq. 9: cones of Hunt, Pointer and Estevez, rows as printed.
glm::dmat3 hunt_cones() {
    return glm::transpose(
        glm::dmat3(0.38971, 0.68898, -0.07868, -0.22981, 1.18340, 0.04641, 0, 0, 1));
}

double achromatic(const glm::dvec3 &response) {
    return 2 * response.x + response.y + response.z / 20 - 0.305;
}

} // namespace

AppearanceModel::AppearanceModel(const glm::dvec3 &white_xyz)
    // Equal energy is the white that the cones of Hunt have equal signals for.
    : to_cones_(hunt_cones() *
                adaptation_matrix(Adaptation::cat02, white_xyz, glm::dvec3(kWhiteY))),
      white_response_(achromatic(responses(white_xyz))) {}

glm::dvec3 AppearanceModel::responses(const glm::dvec3 &xyz) const {
    const double factor = luminance_factor();
    glm::dvec3 response = to_cones_ * xyz;
    for (int i = 0; i < 3; ++i) {
        const double x = std::pow(factor * std::abs(response[i]) / 100, 0.42);
        response[i] = std::copysign(400 * x / (27.13 + x), response[i]) + 0.1;
    }
    return response;
}

glm::dvec3 AppearanceModel::uniform(const glm::dvec3 &xyz) const {
    const glm::dvec3 r = responses(xyz);
    // [CIE159] Eq. 14 to 24; the factor of the background takes itself out of J.
    const double a = r.x - 12 * r.y / 11 + r.z / 11, b = (r.x + r.y - 2 * r.z) / 9;
    const double hue = std::atan2(b, a);
    const double eccentricity = (std::cos(hue + 2) + 3.8) / 4;
    const double background = 0.725 * std::pow(1 / kN, 0.2);
    const double z = 1.48 + std::sqrt(kN);
    const double lightness =
        100 * std::pow(std::max(0.0, achromatic(r)) / white_response_, kSurround * z);
    const double t = 50'000.0 / 13 * background * eccentricity * std::hypot(a, b) /
                     (r.x + r.y + 21.0 / 20 * r.z);
    const double chroma =
        std::pow(t, 0.9) * std::sqrt(lightness / 100) * std::pow(1.64 - std::pow(0.29, kN), 0.73);
    const double colourfulness = chroma * std::pow(luminance_factor(), 0.25);
    // [CIE224] Eq. 17 to 20
    const double m = std::log1p(0.0228 * colourfulness) / 0.0228;
    return {1.7 * lightness / (1 + 0.007 * lightness), m * std::cos(hue), m * std::sin(hue)};
}

} // namespace tsuya

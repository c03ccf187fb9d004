#pragma once
/// \file
/// Angles and the directions that they name.

#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace tsuya {

inline constexpr double kPi = std::numbers::pi;
inline constexpr float kPiF = std::numbers::pi_v<float>;
inline constexpr double kHalfPi = kPi / 2;
inline constexpr float kHalfPiF = kPiF / 2;
inline constexpr double kDegree = kPi / 180; ///< radians of one degree

/// The unit direction `theta` from the normal z and `phi` from x about it, both in radians. Within
/// 1e-12 of theta = pi/2 its z is exactly 0: it lies on the horizon and not, by rounding, above it.
inline glm::dvec3 direction_of(double theta, double phi) {
    const double sine = std::sin(theta);
    const double cosine = std::abs(theta - kPi / 2) < 1e-12 ? 0.0 : std::cos(theta);
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

} // namespace tsuya

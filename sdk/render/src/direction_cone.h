#pragma once
// Directions within a cone, sampled evenly.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/frame.h"

namespace tsuya {

// 1 - cosine of the angle with this square of its sine, up to a right angle: exact for small ones
// too.
inline float one_minus_cosine(float sine2) {
    return sine2 / (1 + std::sqrt(std::max(0.0f, 1 - sine2)));
}

// \param one_minus_cos of the half angle
inline glm::vec3 sample_cone(const glm::vec3 &axis, float one_minus_cos, glm::vec2 u) {
    const float drop = u.x * one_minus_cos; // 1 - cosine from the axis
    const float sine = std::sqrt(std::max(0.0f, drop * (2 - drop))), phi = 2 * kPiF * u.y;
    const Frame frame = make_frame(axis);
    return frame.to_world({sine * std::cos(phi), sine * std::sin(phi), 1 - drop});
}

// Density of sample_cone, 1/sr.
inline float cone_pdf(float one_minus_cos) { return 1 / (2 * kPiF * one_minus_cos); }

} // namespace tsuya

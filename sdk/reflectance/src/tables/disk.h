#pragma once
// The equal-area disk of the hemisphere and the equal-area map between square and disk.

#include <cmath>

#include <glm/glm.hpp>

#include "tables/fast_trig.h"

namespace tsuya {

// Direction with z >= 0 to the unit disk: radius sqrt(2) sin(theta/2), area 1/(2) per sr.
inline glm::vec2 disk_of_direction(const glm::vec3 &d) {
    return glm::vec2(d) / std::sqrt(1.0f + d.z);
}

inline glm::vec3 direction_of_disk(const glm::vec2 &p) {
    const float r2 = std::fmin(glm::dot(p, p), 1.0f);
    return {p * std::sqrt(2.0f - r2), 1.0f - r2};
}

// [Shirley] concentric map of the unit square to the unit disk, and back.
inline glm::vec2 disk_of_square(const glm::vec2 &u) {
    constexpr float kQuarterPi = 0.785398163f;
    const float a = 2.0f * u.x - 1.0f, b = 2.0f * u.y - 1.0f;
    if (a == 0 && b == 0)
        return {0, 0};
    const bool wide = std::abs(a) > std::abs(b);
    const float radius = wide ? a : b, phi = kQuarterPi * (wide ? b / a : a / b);
    const SineCosine turned = sine_cosine(std::abs(phi));
    const float along = radius * turned.cosine, across = radius * std::copysign(turned.sine, phi);
    return wide ? glm::vec2(along, across) : glm::vec2(across, along);
}

inline glm::vec2 square_of_disk(const glm::vec2 &p) {
    constexpr float kFourOverPi = 1.27323954f;
    const float r = std::fmin(glm::length(p), 1.0f);
    const float x = std::abs(p.x), y = std::abs(p.y);
    // The larger coordinate becomes the radius, the other the angle from it
    const bool steep = y >= x;
    const float b = r * kFourOverPi * (steep ? angle_of(x, y) : angle_of(y, x));
    const float u = std::copysign(steep ? b : r, p.x), v = std::copysign(steep ? r : b, p.y);
    return {0.5f * (u + 1.0f), 0.5f * (v + 1.0f)};
}

} // namespace tsuya

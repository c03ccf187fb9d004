#pragma once
// The equal-area disk of the hemisphere and the equal-area map between square and disk.

#include <cmath>

#include <glm/glm.hpp>

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
    if (std::abs(a) > std::abs(b)) {
        const float phi = kQuarterPi * (b / a);
        return {a * std::cos(phi), a * std::sin(phi)};
    }
    const float phi = kQuarterPi * (a / b);
    return {b * std::sin(phi), b * std::cos(phi)};
}

inline glm::vec2 square_of_disk(const glm::vec2 &p) {
    constexpr float kFourOverPi = 1.27323954f;
    const float r = std::fmin(glm::length(p), 1.0f);
    float a, b;
    if (std::abs(p.x) > std::abs(p.y)) {
        a = std::copysign(r, p.x);
        b = a * kFourOverPi * std::atan(p.y / p.x);
    } else {
        b = std::copysign(r, p.y);
        a = p.y == 0 ? 0.0f : b * kFourOverPi * std::atan(p.x / p.y);
    }
    return {0.5f * (a + 1.0f), 0.5f * (b + 1.0f)};
}

} // namespace tsuya

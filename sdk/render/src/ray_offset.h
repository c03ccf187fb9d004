#pragma once
// Where a ray starts so that it does not meet the surface it leaves.

#include <cmath>
#include <cstdint>
#include <cstring>

#include <glm/glm.hpp>

namespace tsuya {

// [Wachter] the point moved along the geometric normal by a few units in the last place of each
// coordinate, and by a fixed small length near the origin: the error bound of a point interpolated
// in a triangle.
inline glm::vec3 offset_ray(const glm::vec3 &point, const glm::vec3 &normal) {
    constexpr float kNearOrigin = 1.0f / 32.0f, kFloatScale = 1.0f / 65536.0f, kIntScale = 256.0f;
    glm::vec3 moved;
    for (int c = 0; c < 3; ++c) {
        const auto steps = static_cast<std::int32_t>(kIntScale * normal[c]);
        std::int32_t bits;
        std::memcpy(&bits, &point[c], sizeof bits);
        bits += point[c] < 0 ? -steps : steps;
        float by_steps;
        std::memcpy(&by_steps, &bits, sizeof by_steps);
        moved[c] = std::abs(point[c]) < kNearOrigin ? point[c] + kFloatScale * normal[c] : by_steps;
    }
    return moved;
}

} // namespace tsuya

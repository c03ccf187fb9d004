#pragma once
// Where a ray starts so that it does not meet the surface it leaves.

#include <array>

#include <glm/glm.hpp>

namespace tsuya {

// How far a point of a triangle may lie from the triangle's plane as a ray meets it: a bound of
// what rounding does to the point that is interpolated between the corners, to the start of the ray
// and to the meeting itself. In proportion to the coordinates, so the unit of a scene does not
// matter. Differs from [Wachter]: the bound follows the corners, not the point, so it needs no
// fixed length near the origin.
inline float position_error(const std::array<glm::vec3, 3> &corner, const glm::vec3 &normal) {
    constexpr float kRoundings = 64,
                    kRounding = 1.0f / 16777216.0f; // half a unit in the last place
    const glm::vec3 largest =
        glm::max(glm::max(glm::abs(corner[0]), glm::abs(corner[1])), glm::abs(corner[2]));
    return kRoundings * kRounding * glm::dot(glm::abs(normal), largest);
}

} // namespace tsuya

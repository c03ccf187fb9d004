#pragma once
// Where a ray starts so that it does not meet the surface it leaves.

#include <array>
#include <cmath>

#include <glm/glm.hpp>

namespace tsuya {

// [Wachter] How far a point of a triangle may lie from the triangle's plane as a ray meets it: a
// bound of what rounding does to the point that is interpolated between the corners, to the start
// of the ray, and to the meeting itself, which is computed from edges. In proportion to lengths, so
// that the unit of a scene does not matter: the bound follows the corners, not the point, and needs
// no fixed length near the origin.
inline float position_error(const std::array<glm::vec3, 3> &corner, const glm::vec3 &normal) {
    constexpr float kRoundings = 64, kOfEdges = 4,
                    kRounding = 1.0f / 16777216.0f; // half a unit in the last place
    const auto longest = [](const glm::vec3 &v) {
        return glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
    };
    const glm::vec3 largest =
        glm::max(glm::max(glm::abs(corner[0]), glm::abs(corner[1])), glm::abs(corner[2]));
    const float edge = glm::max(longest(corner[1] - corner[0]), longest(corner[2] - corner[0]));
    return kRounding * (kRoundings * glm::dot(glm::abs(normal), largest) + kOfEdges * edge);
}

} // namespace tsuya

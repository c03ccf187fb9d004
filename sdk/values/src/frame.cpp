#include "tsuya/sdk/frame.h"

#include <cmath>

namespace tsuya {

Frame make_frame(const glm::vec3 &normal, const glm::vec3 &warp) {
    const glm::vec3 tangent = warp - glm::dot(warp, normal) * normal;
    const float length2 = glm::dot(tangent, tangent);
    if (!(length2 > 1e-12f * glm::dot(warp, warp)) || !std::isfinite(length2))
        return make_frame(normal);
    // Again, for the little that is left of a nearly parallel warp is mostly rounding
    const glm::vec3 rough = tangent / std::sqrt(length2);
    const glm::vec3 unit = glm::normalize(rough - glm::dot(rough, normal) * normal);
    return {glm::cross(unit, normal), unit, normal};
}

Frame make_frame(const glm::vec3 &n) {
    // [Duff] listing 3
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {
        {1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

} // namespace tsuya

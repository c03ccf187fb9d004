#pragma once
/// \file
/// Filling a ray of Embree, in layers that trace with it.

#include <glm/glm.hpp>

namespace tsuya::detail {

/// \tparam Ray RTCRay: no header of Embree is needed here
template <class Ray>
Ray make_ray(const glm::vec3 &origin, const glm::vec3 &direction, float farthest) {
    return {.org_x = origin.x,
            .org_y = origin.y,
            .org_z = origin.z,
            .tnear = 0,
            .dir_x = direction.x,
            .dir_y = direction.y,
            .dir_z = direction.z,
            .time = 0,
            .tfar = farthest,
            .mask = ~0u,
            .id = 0,
            .flags = 0};
}

} // namespace tsuya::detail

#pragma once
/// \file
/// The frame of a point of cloth: x = weft, y = warp, z = normal.

#include <glm/glm.hpp>

namespace tsuya {

/// Right-handed orthonormal frame.
struct Frame {
    glm::vec3 weft{1, 0, 0};
    glm::vec3 warp{0, 1, 0};
    glm::vec3 normal{0, 0, 1};

    /// Components of a direction along weft, warp and normal.
    glm::vec3 to_local(const glm::vec3 &d) const {
        return {glm::dot(d, weft), glm::dot(d, warp), glm::dot(d, normal)};
    }
    /// The inverse of to_local.
    glm::vec3 to_world(const glm::vec3 &d) const { return d.x * weft + d.y * warp + d.z * normal; }
};

/// The frame that keeps `normal` exactly and `warp` as far as it is perpendicular to it. Any frame
/// about the normal where warp is parallel to it, zero or not finite. Never NaN for a unit normal.
Frame make_frame(const glm::vec3 &normal, const glm::vec3 &warp);

/// Any frame about a unit normal, continuous but at normal.z = -1 (Duff et al. 2017, `[Duff]`).
Frame make_frame(const glm::vec3 &normal);

} // namespace tsuya

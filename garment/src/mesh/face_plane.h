#pragma once
/// \file
/// Normal and area of a polygon that need not be flat.

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// The area vector of a face in two parts.
struct FacePlane {
    glm::dvec3 normal{0.0}; ///< unit; 0 where the face has no area
    double area = 0.0;      ///< square metres
};

inline FacePlane face_plane(const PolygonMesh &mesh, std::size_t f) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin = mesh.position[mesh.corner_position[mesh.face_offset[f]]];
    for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
        sum += glm::cross(mesh.position[mesh.corner_position[c]] - origin,
                          mesh.position[mesh.corner_position[mesh.next(f, c)]] - origin);
    const double length = glm::length(sum);
    return {length > 0.0 ? sum / length : glm::dvec3(0.0), 0.5 * length};
}

/// Normal of a face; z where it has no area.
inline glm::dvec3 any_normal(const PolygonMesh &mesh, std::size_t f) {
    const FacePlane plane = face_plane(mesh, f);
    return plane.area > 0.0 ? plane.normal : glm::dvec3(0, 0, 1);
}

} // namespace tsuya::garment

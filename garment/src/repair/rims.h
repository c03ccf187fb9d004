#pragma once
/// \file
/// Which rims of cloth face each other, and which lie on each other.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// An edge of the boundary as seen from one of its points.
struct RimEdge {
    glm::dvec3 along;  ///< away from the point, unit
    glm::dvec3 inward; ///< across the edge into its face, unit
};

/// The edge that starts at a corner, as seen from its start (`forward`) or its end. Zero vectors
/// where the face has no area.
RimEdge rim_edge(const PolygonMesh &mesh, std::uint32_t face, std::uint32_t corner, bool forward);

/// How two rims that meet at a place lie.
enum class Contact {
    none,  ///< they run apart
    seam,  ///< side by side, the faces on opposite sides or at an angle above 45 degrees
    folded ///< side by side, the faces on one side: layers, or a seam where cloth is folded over
};

Contact contact_of(const std::vector<RimEdge> &a, const std::vector<RimEdge> &b);

} // namespace tsuya::garment

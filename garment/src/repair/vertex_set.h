#pragma once
/// \file
/// Vertices that a step of the repair may touch.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// A vertex moves by less than this share of its shortest edge.
inline constexpr double kEdgeShare = 0.45;

/// The vertices that may be joined: those of `member`, or all where it is empty.
struct VertexSet {
    std::vector<bool> member{};
    bool has(std::uint32_t v) const { return member.empty() || (v < member.size() && member[v]); }
};

/// Narrow gaps that are left along seams: boundary loops and their vertices.
struct Slits {
    std::size_t count = 0;
    VertexSet vertices{};
};

/// Bounding box of all positions.
struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::max()};
    glm::dvec3 upper{std::numeric_limits<double>::lowest()};
};

inline Box bounds(const PolygonMesh &mesh) {
    Box box;
    for (const glm::dvec3 &p : mesh.position) {
        box.lower = glm::min(box.lower, p);
        box.upper = glm::max(box.upper, p);
    }
    return box;
}

} // namespace tsuya::garment

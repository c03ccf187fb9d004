#pragma once
/// \file
/// What of the boundary faces what: vertices that become one, and vertices that lie on an edge.

#include <cstdint>
#include <vector>

#include "repair/layers.h"
#include "repair/open_sides.h"
#include "repair/vertex_set.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// A vertex to be put into an edge, at `t` from the start of the edge's side.
struct Insertion {
    std::uint32_t corner; ///< where the side of the edge starts
    double t;
    std::uint32_t vertex;
    double distance;
    std::uint32_t origin = 0; ///< see Sewing
};

/// What is to be sewn.
struct Pairing {
    /// Vertices that become one, at their mean, ascending; the first stands for all.
    std::vector<std::vector<std::uint32_t>> clusters{};
    std::vector<Insertion> insertions{}; ///< by corner, then t
    double largest_gap = 0.0;            ///< metres

    bool empty() const { return clusters.empty() && insertions.empty(); }
};

/// Which vertices and sides may be paired.
struct PairingRules {
    double tolerance;         ///< metres
    const VertexSet &allowed; ///< both ends of a side
    const LayeredParts &layers;
    bool join_vertices; ///< or only put them into edges
};

/// Looks at the sides that pass each vertex of the boundary. Vertices within the tolerance become
/// one, the nearest pairs first, never two of one face. Where there are none, a vertex that lies on
/// a side which it does not touch is put into the nearest. Throws Interrupted.
/// \param mesh manifold where vertices are joined
Pairing pair_sides(const PolygonMesh &mesh, const OpenSides &sides, const PairingRules &rules,
                   const Progress &progress);

} // namespace tsuya::garment

#pragma once
/// \file
/// A mesh while its panels are sewn: vertices are put into edges.

#include <cstdint>
#include <vector>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/position_recipe.h"

namespace tsuya::garment {

/// A vertex to be put into an edge, at `t` from the start of the edge's side.
struct Insertion {
    std::uint32_t corner; ///< where the side of the edge starts
    double t;
    std::uint32_t vertex;
    double distance;
    std::uint32_t origin = 0; ///< see Sewn
};

/// A mesh while it is being sewn. `origin` tells, per corner, its vertex before anything was
/// joined, so that edges which were laid onto each other can be told apart. A new corner gets a new
/// number, the same on both sides of an edge inside a panel.
struct Sewn {
    PolygonMesh mesh;
    std::vector<std::uint32_t> origin;
    std::uint32_t next_origin = 0;
    bool triangles = false; ///< all faces are, and shall stay, triangles
};

/// Puts the vertices into their edges: triangles become more triangles, other faces get corners.
/// \param insertions sorted by corner, then t
Sewn insert_vertices(const Sewn &sewn, const std::vector<Insertion> &insertions);

/// Where joining laid an edge inside a panel onto another edge (a fold one edge deep), the edge
/// gets a vertex in its middle, so that the two stay different.
void halve_coincident_edges(Sewn &sewn, PositionRecipe &recipe);

} // namespace tsuya::garment

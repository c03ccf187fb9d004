#pragma once
/// \file
/// Edges that only one face has, by place.

#include <optional>
#include <vector>

#include "mesh/edges.h"
#include "mesh/place_grid.h"
#include "repair/sewing.h"
#include "repair/vertex_joiner.h"

namespace tsuya::garment {

/// Sides of edges between `allowed` vertices that only one face has.
std::vector<EdgeUse> open_edges(const PolygonMesh &mesh, const VertexSet &allowed);

/// Their ends, ascending.
std::vector<std::uint32_t> ends_of(const std::vector<EdgeUse> &edges);

/// Open vertices that lie on an open edge which they do not touch, each with the nearest such edge,
/// sorted by corner and place.
std::vector<Insertion> find_insertions(const PolygonMesh &mesh, double tolerance,
                                       const VertexSet &allowed);

} // namespace tsuya::garment

#pragma once
/// \file
/// Boundary vertices that lie at one place become one vertex.

#include <limits>
#include <vector>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/position_recipe.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

/// A vertex moves by less than this share of its shortest edge.
inline constexpr double kEdgeShare = 0.45;

/// The vertices that may be joined: those of `member`, or all where it is empty.
struct VertexSet {
    std::vector<bool> member{};
    bool has(std::uint32_t v) const { return member.empty() || (v < member.size() && member[v]); }
};

/// Bounding box of all positions.
struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::max()};
    glm::dvec3 upper{std::numeric_limits<double>::lowest()};
};
Box bounds(const PolygonMesh &mesh);

/// Joins boundary vertices of a manifold mesh that lie within the tolerance, the nearest pairs
/// first, at their mean; never two of one face.
PolygonMesh join_vertices(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                          PositionRecipe &recipe, SeamReport &report);

/// Joins the ends of edges between `allowed` vertices that are no longer than the tolerance; their
/// triangles are left without area. Returns the number of edges.
std::size_t collapse_short_edges(PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                                 PositionRecipe &recipe);

} // namespace tsuya::garment

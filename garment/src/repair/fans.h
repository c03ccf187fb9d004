#pragma once
/// \file
/// Fans of faces about vertices: how a mesh that is not manifold is taken apart.

#include <cstddef>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/position_recipe.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

/// Joins the sides of each edge in pairs of opposite directions and gives each fan of faces about a
/// vertex that follows from it a vertex of its own. Where more than two faces meet in an edge (the
/// layers of a pleat, a pocket), sides that are neighbours around an end of the edge are paired
/// first, then sides of different panels, then the flattest; what is left over stays open.
/// Returns the number of new vertices.
std::size_t split_fans(PolygonMesh &mesh, PositionRecipe &recipe);

/// Gives faces whose edges are still not manifold vertices of their own. Returns their number.
std::size_t detach_faces(PolygonMesh &mesh, PositionRecipe &recipe);

/// Keeps the place of the first finding of each key.
void keep_place(FirstPlaces &places, const std::string &key, const glm::dvec3 &p);

/// Unit normal of a face's area vector; 0 where it has no area. \param area the area
glm::dvec3 face_normal(const PolygonMesh &mesh, std::size_t f, double &area);

} // namespace tsuya::garment

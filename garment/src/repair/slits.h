#pragma once
/// \file
/// Narrow gaps that are left along seams.

#include "repair/vertex_joiner.h"

namespace tsuya::garment {

/// Vertices of the boundary loops of a manifold mesh that are nowhere wider than `width`. Returns
/// the number of loops.
std::size_t find_slits(const PolygonMesh &mesh, double width, VertexSet &slits);

} // namespace tsuya::garment

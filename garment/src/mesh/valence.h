#pragma once
/// \file
/// A bound on the number of faces about a vertex.

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// The time of a vertex grows with the square of its faces, and more; cloth needs no such vertices.
inline constexpr std::uint32_t kMaxValence = 256;

/// Throws Error for a vertex of kMaxValence corners or more.
void check_valence(const PolygonMesh &mesh);

} // namespace tsuya::garment

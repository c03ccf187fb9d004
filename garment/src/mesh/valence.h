#pragma once
/// \file
/// A bound on the number of faces about a vertex.

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// The time of a vertex grows with the square of its faces, and more; cloth needs no such vertices.
inline constexpr std::uint32_t kMaxValence = 256;

/// In a file, where faces that only touch may share a vertex, and faces may be concave outlines.
inline constexpr std::uint32_t kMaxFileValence = 2048, kMaxFaceSize = 1024;

/// Throws Error for a vertex of kMaxFileValence corners, or a face of kMaxFaceSize, or more: before
/// steps whose time grows with their squares.
void check_sizes(const PolygonMesh &mesh);

/// Throws Error for a vertex of kMaxValence corners or more.
void check_valence(const PolygonMesh &mesh);

} // namespace tsuya::garment

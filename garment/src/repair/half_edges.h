#pragma once
/// \file
/// The half-edges (OpenMesh) of a manifold mesh, and what is read off them.

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Vertices, half-edges and faces without positions, which stay with the polygon mesh.
using HalfEdgeMesh = OpenMesh::PolyConnectivity;

/// Half-edges with the same vertex and face numbers as `mesh`. Throws Error if the mesh is not
/// manifold; make_manifold makes it so.
HalfEdgeMesh make_half_edges(const PolygonMesh &mesh, const Progress &progress);

/// One boundary loop as half-edges that have no face, in their order.
using BoundaryRun = std::vector<HalfEdgeMesh::HalfedgeHandle>;
std::vector<BoundaryRun> boundary_runs(const HalfEdgeMesh &half_edges);

/// Number of the vertex where a half-edge starts.
std::uint32_t start_of(const HalfEdgeMesh &half_edges, HalfEdgeMesh::HalfedgeHandle h);

/// Length and place of each loop, longest first.
std::vector<BoundaryLoop> measure_loops(const PolygonMesh &mesh, const HalfEdgeMesh &half_edges);

} // namespace tsuya::garment

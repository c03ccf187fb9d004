#pragma once
/// \file
/// The half-edge mesh (OpenMesh) of a manifold mesh, and what is read off it.

#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

struct TopologyTraits : OpenMesh::DefaultTraits {
    using Point = OpenMesh::Vec3d;
    VertexAttributes(OpenMesh::Attributes::None);
    FaceAttributes(OpenMesh::Attributes::None);
    EdgeAttributes(OpenMesh::Attributes::None);
    HalfedgeAttributes(OpenMesh::Attributes::PrevHalfedge);
};
using HalfEdgeMesh = OpenMesh::PolyMesh_ArrayKernelT<TopologyTraits>;

/// Half-edges with the same vertex and face numbers as `mesh`. Throws Error if the mesh is not
/// manifold; make_manifold makes it so.
HalfEdgeMesh make_half_edges(const PolygonMesh &mesh);

/// One boundary loop as half-edges that have no face, in their order.
using BoundaryRun = std::vector<HalfEdgeMesh::HalfedgeHandle>;
std::vector<BoundaryRun> boundary_runs(const HalfEdgeMesh &mesh);

/// Length and place of each loop, longest first.
std::vector<BoundaryLoop> measure_loops(const HalfEdgeMesh &mesh);

/// Connected parts.
std::size_t count_parts(const HalfEdgeMesh &mesh);

} // namespace tsuya::garment

#pragma once
/// \file
/// UV islands of a mesh whose edges are known.

#include "mesh/disjoint_sets.h"
#include "mesh/edges.h"

namespace tsuya::garment {

/// The island of each face, see uv_islands. \param edges of `mesh`
SetNumbers find_islands(const PolygonMesh &mesh, const EdgeTable &edges);

/// Panels of a mesh as PolygonMesh has them.
struct Panels {
    std::vector<std::uint32_t> of_face{};
    std::vector<std::string> name{};
    std::vector<PanelLabel> label{};
};

/// A panel of each island of a panel, see split_panels_by_island.
Panels panels_of_islands(const PolygonMesh &mesh, const SetNumbers &islands);

/// Makes these the panels of the mesh.
void name_islands(PolygonMesh &mesh, const SetNumbers &islands);

/// Connected parts of faces that share vertices: of each vertex; any number for one without a face.
SetNumbers find_parts(const PolygonMesh &mesh);

} // namespace tsuya::garment

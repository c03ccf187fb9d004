#pragma once
/// \file
/// UV islands of a mesh whose edges are known.

#include "mesh/disjoint_sets.h"
#include "mesh/edges.h"

namespace tsuya::garment {

/// The island of each face, see uv_islands. \param edges of `mesh`
SetNumbers find_islands(const PolygonMesh &mesh, const EdgeTable &edges);

/// Makes a panel of each island of a panel, see split_panels_by_island.
void name_islands(PolygonMesh &mesh, const SetNumbers &islands);

} // namespace tsuya::garment

#pragma once
/// \file
/// What is wrong with a garment mesh, and what loading it would do about it.

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/report.h"
#include "tsuya/garment/seams.h"

namespace tsuya::garment {

/// Examines a mesh and dry-runs the repairs that `load` does. Never throws for a bad shape, only
/// for bad indices (see check_indices). \param metres mesh with positions in metres
Report check(const PolygonMesh &metres, const SeamOptions &options = {});

/// A mesh that is ready to be subdivided, and what was done to it.
struct Prepared {
    PolygonMesh mesh{}; ///< manifold, oriented, seams joined
    Report report{};
    PositionRecipe positions{}; ///< how its positions follow from those of the file
};

/// Does the repairs: drops faces, cuts what is not manifold, joins the seams, turns faces over.
/// Throws Error for bad indices, and where no face is left.
Prepared prepare(const PolygonMesh &metres, const SeamOptions &options = {});

} // namespace tsuya::garment

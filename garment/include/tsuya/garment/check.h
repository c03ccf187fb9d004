#pragma once
/// \file
/// What is wrong with a garment mesh, and what loading it would do about it.

#include <optional>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/position_recipe.h"
#include "tsuya/garment/report.h"
#include "tsuya/garment/seams.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Examines a mesh and dry-runs the repairs that `load` does. Never throws for a bad shape, only
/// for bad indices (see check_indices), and Interrupted where `progress` says stop.
/// \param metres mesh with positions in metres
/// \param metres_per_uv see Options::metres_per_uv
/// \param unit_stated see Options::unit_stated
Report check(PolygonMesh metres, const SeamOptions &options = {}, const Progress &progress = {},
             const std::optional<double> &metres_per_uv = {}, bool unit_stated = false);

/// A finding `probably_z_up` where the mesh stands upright along z: it is longer along z than along
/// y, and of its two longest openings (hem and neck, hem and waist) one lies above the other along
/// z, apart by half of the mesh or more, and aside by a fifth of that at most.
std::optional<Finding> find_up_axis(const Report &report);

/// A mesh that is ready to be subdivided, and what was done to it.
struct Prepared {
    PolygonMesh mesh{}; ///< manifold, oriented, seams joined
    Report report{};
    PositionRecipe positions{}; ///< how its positions follow from those of the file
};

/// Does the repairs: drops faces, cuts what is not manifold, joins the seams (see SeamOptions),
/// turns faces over. Throws Error for bad indices, and where no face is left; Interrupted.
Prepared prepare(PolygonMesh metres, const SeamOptions &options = {},
                 const Progress &progress = {});

/// Makes every edge border at most two faces of one orientation and every vertex join one fan of
/// faces, as half-edge meshes need: drops degenerate and duplicate faces and isolated vertices,
/// turns faces over where that makes neighbours agree (the larger area of a part keeps its side),
/// takes the sides of crowded edges in pairs (layers of a pleat), and cuts open what remains. What
/// was done is counted in `report.file`. Throws Error for bad indices.
Prepared make_manifold(PolygonMesh mesh);

} // namespace tsuya::garment

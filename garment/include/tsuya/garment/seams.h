#pragma once
/// \file
/// Seams: panels that lie edge to edge are joined, while their UVs stay apart.

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/garment/position_recipe.h"
#include "tsuya/garment/report.h"

namespace tsuya::garment {

/// How near boundary vertices must be to be joined.
struct SeamOptions {
    double tolerance = 0.5e-3; ///< metres, 0 to join only equal positions; negative: do not join
    /// Metres. Gaps that remain and are nowhere wider than this, such as where a sewn edge hangs
    /// off its neighbour between two points, are closed as well; 0: leave them.
    double slit_width = 2e-3;
};

/// Joins boundary vertices that lie within the tolerance of each other, and puts a boundary vertex
/// that lies on a neighbour's boundary edge into that edge (a T-junction): triangles are divided
/// into triangles, larger faces get one corner more. The UV of a new corner is interpolated along
/// the edge; the UVs of the two sides stay apart. Two vertices of one face are not joined, but for
/// edges shorter than the tolerance that hold a slit open; else a vertex moves by less than half of
/// its shortest edge. Where joining lays more than two layers
/// onto each other (a pleat), they are joined in pairs. \param mesh manifold, with valid indices
/// (see make_manifold) \param manifold adds up what was done to keep the result manifold
/// \param recipe gets what was done to the positions
PolygonMesh join_seams(const PolygonMesh &mesh, const SeamOptions &options, SeamReport &report,
                       ManifoldReport &manifold, PositionRecipe &recipe);

/// Makes every edge border at most two faces of one orientation and every vertex join one fan of
/// faces, as half-edge meshes need: drops degenerate and duplicate faces and isolated vertices,
/// turns faces over where that makes neighbours agree (the larger area of a part keeps its side),
/// takes the sides of crowded edges in pairs (layers of a pleat), and cuts open what remains. All
/// of it is counted. \param mesh valid indices \param recipe gets what was done to the positions
PolygonMesh make_manifold(const PolygonMesh &mesh, ManifoldReport &report, PositionRecipe &recipe);

} // namespace tsuya::garment

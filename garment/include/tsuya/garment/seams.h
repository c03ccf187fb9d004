#pragma once
/// \file
/// Seams: panels that lie edge to edge are joined, while their UVs stay apart.

#include <optional>

namespace tsuya::garment {

/// How near boundary vertices must be to be joined. Boundary vertices within the tolerance of each
/// other become one, and a boundary vertex that lies on a neighbour's boundary edge is put into
/// that edge (a T-junction): triangles are divided into triangles, larger faces get one corner
/// more. The UV of a new corner is interpolated along the edge; the UVs of the two sides stay
/// apart. Two vertices of one face are not joined, but for edges shorter than the tolerance that
/// hold a slit open; else a vertex moves by less than half of its shortest edge. Where joining lays
/// more than two layers onto each other (a pleat), they are joined in pairs.
struct SeamOptions {
    /// Metres, 0 to join only equal positions; negative: do not join. Empty: 0.5 mm, and on a mesh
    /// smaller than 3 cm or larger than 30 m, which is not in the unit that was stated, the power
    /// of ten of that which fits its size; so is the width of slits then.
    std::optional<double> tolerance{};
    /// Metres. Gaps that remain and are nowhere wider than this, such as where a sewn edge hangs
    /// off its neighbour between two points, are closed as well; 0: leave them.
    double slit_width = 2e-3;
};

} // namespace tsuya::garment

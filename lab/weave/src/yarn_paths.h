#pragma once
/// \file
/// Heights of the axes of all yarns of a repeat: see weave_geometry.h.

#include <vector>

#include "tsuya/lab/draft.h"
#include "tsuya/sdk/progress.h"
#include "yarn_section.h"

namespace tsuya::lab::detail {

struct PathProblem {
    Draft draft{};
    double warp_spacing = 0, weft_spacing = 0; ///< metres: of ends along x, of picks along y
    YarnSection warp{}, weft{};
    int points = 12;                           ///< per crossing, even
    double stiffness_length = 0;               ///< share of a crossing
    double warp_tension = 1, weft_tension = 1; ///< of a yarn; the ratio matters
};

/// Heights in metres, row by row: yarn by yarn, each at `points` places per crossing. Place k of a
/// warp yarn is y = k / points of a pick's spacing; pick p lies at p + 1/2 spacings. Weft alike.
struct YarnPaths {
    std::vector<double> warp{}, weft{};
    int warp_points = 0, weft_points = 0; ///< of one yarn over the repeat
    double thickness = 0;                 ///< of the cloth, metres
    double overlap = 0;                   ///< of yarns that found no room, metres

    double warp_height(int end, int place) const;
    double weft_height(int pick, int place) const;
};

/// Paths with the middle of the cloth at 0. Throws Interrupted where progress.stop becomes true.
YarnPaths solve_paths(const PathProblem &problem, const Progress &progress = {});

} // namespace tsuya::lab::detail

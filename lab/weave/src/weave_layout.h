#pragma once
/// \file
/// A weave in metres, with the paths of its yarns: what filaments and report are both made from.

#include <array>

#include "tsuya/lab/weave_geometry.h"
#include "yarn_paths.h"
#include "yarn_section.h"

namespace tsuya::lab::detail {

struct WeaveLayout {
    Draft draft{};
    double warp_spacing = 0, weft_spacing = 0; ///< of ends along x, of picks along y, metres
    YarnSection warp{}, weft{};                ///< as they lie in the cloth
    FilamentPacking warp_packing{}, weft_packing{};
    std::array<FilamentSection, 2> section{};
    int points = 12; ///< of a path per crossing
    int tiles_x = 1, tiles_y = 1;
    double warp_turns = 0, weft_turns = 0; ///< whole, over all tiles
    double squeeze = 0;                    ///< share of their width that jammed yarns lost
    YarnPaths paths{};
};

/// Throws Error like build_filaments.
WeaveLayout lay_out(const Weave &weave, const GeometryOptions &options,
                    const Progress &progress = {});

} // namespace tsuya::lab::detail

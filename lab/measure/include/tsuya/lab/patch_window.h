#pragma once
/// \file
/// Which pixels of a patch make whole repeats of the weave.

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// One repeat of the weave as the camera sees it, in pixels. Columns lie across the plane of view,
/// rows along it, and are foreshortened by cos(theta_r).
struct PictureLattice {
    glm::dvec2 weft{0}, warp{0};
};

/// \param repeat_mm along weft and warp, > 0
/// \param pixel_mm one pixel on the cloth seen from straight above, > 0
PictureLattice lattice_in_picture(const std::array<double, 2> &repeat_mm, double pixel_mm,
                                  const DirectionPair &directions);

/// Weights of the pixels of a patch.
struct PatchWindow {
    std::vector<double> weights{}; ///< side x side, rows from the top, of sum 1
    /// The mean over them is free of the weave's period: they cover whole repeats, or three and
    /// more of them under a Hann window.
    bool whole_repeats = false;
};

/// Every pixel alike.
PatchWindow even_window(int side);

/// The largest window in a patch of `side` pixels that is free of the weave's period: where three
/// repeats fit along both yarns, a Hann window over as many as fit, else a parallelogram of whole
/// repeats, with the pixels at its edge by their share. even_window where no repeat fits.
PatchWindow repeat_window(int side, const PictureLattice &lattice);

} // namespace tsuya::lab

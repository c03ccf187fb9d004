#pragma once
/// \file
/// Maps of what was measured of a fabric, and of the facets that it shows.

#include <filesystem>

#include "tsuya/sdk/fabric.h"

namespace tsuya::scene {

/// Draws, through the program gnuplot, the BARD over the view and the facets' distribution D over
/// their tilt ([Takeda] Eqs. 3-5, with the fabric's f0), both with the feature points. Beyond the
/// tilts that the views show, D is extrapolated, and striped: at more than 45 degrees it is what
/// the model `half_vector` takes. Throws Error as plot_lobes, and for a fabric without measured
/// views above 0.
void plot_maps(const Fabric &fabric, const std::filesystem::path &file);

} // namespace tsuya::scene

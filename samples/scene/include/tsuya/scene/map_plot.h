#pragma once
/// \file
/// Maps of what was measured of a fabric, and of the facets that it shows.

#include <filesystem>

#include "tsuya/sdk/fabric.h"

namespace tsuya::scene {

/// Draws, through the program gnuplot, the BARD over the view and the facets' distribution D over
/// their tilt ([Takeda] Eqs. 3-5, with the fabric's f0). Light from straight above shows tilts up
/// to 45 degrees; beyond, striped, D is what the model `half_vector` extrapolates. F0, Fxz and F2
/// are the feature points of the tables of [Takeda]: the mirror point, and those 45 and 90 degrees
/// along the weft. Throws Error as plot_lobes, and for a fabric without measured views above 0.
void plot_maps(const Fabric &fabric, const std::filesystem::path &file);

} // namespace tsuya::scene

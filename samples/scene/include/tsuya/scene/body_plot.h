#pragma once
/// \file
/// The lobes of a fabric as bodies in space.

#include <filesystem>
#include <string>

#include "tsuya/sdk/fabric.h"

namespace tsuya::scene {

/// Draws, through the program gnuplot, the bodies that BRDF times cos theta_r fills as the radius
/// over the direction to the viewer: outlines of their shadows along the weft, along the warp and
/// from above, for light at 0, 15, 30, 45, 60 and 75 degrees in the weft, bias and warp planes.
/// Each lobe is drawn with its largest value as 1, which the key has in 1/sr: near grazing it is
/// many times that of light from above. \param model see model_names. Throws Error as plot_lobes.
void plot_bodies(const Fabric &fabric, const std::string &model, const std::filesystem::path &file);

} // namespace tsuya::scene

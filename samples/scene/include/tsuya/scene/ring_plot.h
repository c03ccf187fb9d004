#pragma once
/// \file
/// The reflectance of a fabric around rings of equal theta_r, models beside measurement.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::scene {

/// What is drawn.
struct RingPlot {
    Fabric fabric{};
    std::vector<std::string> models = {kDefaultModel}; ///< see model_names; one curve each
    std::optional<ReflectanceTable> against{};         ///< measured points over the curves
    double theta_i = kPi / 4;                          ///< radians, in [0, pi/2)
};

/// Draws, through the program gnuplot, the BRDF over phi_r at theta_r = 30 and 60 degrees, for
/// light at theta_i in the warp, bias and weft planes. Points are the rows of `against` that lie on
/// those rings under that light. Throws Error as plot_lobes; theta_i out of range; no model; none
/// of the rows on a ring.
void plot_rings(const RingPlot &plot, const std::filesystem::path &file);

} // namespace tsuya::scene

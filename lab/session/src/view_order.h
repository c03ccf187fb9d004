#pragma once
/// \file
/// The order in which views are taken.

#include <vector>

#include "tsuya/lab/rig_file.h"
#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// The views of one direction of light.
struct LightViews {
    double theta_i = 0, phi_i = 0; ///< radians
    std::vector<DirectionPair> views{};
};

/// Groups pairs by their light and orders lights and views: those that share the angle of the
/// slowest axis follow each other, among them those that share the angle of the next slower one,
/// each forth and then back. Equal pairs are there once.
std::vector<LightViews> ordered_views(const std::vector<DirectionPair> &pairs, const RigFile &rig);

} // namespace tsuya::lab

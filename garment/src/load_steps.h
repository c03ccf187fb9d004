#pragma once
/// \file
/// Loading a garment, with what further frames of it need.

#include "tsuya/garment/garment.h"
#include "tsuya/garment/position_recipe.h"

namespace tsuya::garment {

struct LoadSteps {
    LoadedGarment garment{};
    Subdivider subdivider;
    PositionRecipe recipe{};
    FrameOptions frames{}; ///< as they were used
};

/// Everything that load does. Throws as load.
LoadSteps load_steps(const PolygonMesh &mesh, const Options &options, const std::string &where,
                     const Progress &progress);

/// The grain that a file's materials state, for panels that `frames` does not name; what was done
/// as findings.
std::vector<Finding> use_hints(const std::vector<FabricHint> &hints, FrameOptions &frames);

} // namespace tsuya::garment

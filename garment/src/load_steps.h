#pragma once
/// \file
/// Loading a garment, with what further frames of it need.

#include <optional>

#include "tsuya/garment/garment.h"
#include "tsuya/garment/position_recipe.h"

namespace tsuya::garment {

struct LoadSteps {
    LoadedGarment garment{};
    std::optional<Subdivider> subdivider{}; ///< where further frames were asked for
    PositionRecipe recipe{};
    FrameOptions frames{}; ///< as they were used
};

/// Whether more frames of the mesh will follow.
enum class Further { none, frames };

/// Everything that load does, for a file with its hints and its findings. Throws as load.
LoadSteps load_steps(MeshFile file, const Options &options, const std::string &where,
                     Further further, const Progress &progress);

} // namespace tsuya::garment

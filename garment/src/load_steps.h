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

/// Everything that load does. `of_file` are findings of the reader. Throws as load.
LoadSteps load_steps(const PolygonMesh &mesh, const Options &options,
                     const std::vector<Finding> &of_file, const std::string &where,
                     const Progress &progress);

/// The same for a file: with its hints and its findings. Throws as load.
LoadSteps load_steps(const MeshFile &file, const Options &options, const std::string &where,
                     const Progress &progress);

} // namespace tsuya::garment

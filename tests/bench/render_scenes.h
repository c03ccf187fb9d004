#pragma once
// The scenes on which the renderer's speed is measured.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/sdk/render.h"

namespace tsuya::bench {

struct RenderScene {
    std::string name{};
    Scene scene{};
    int max_bounces = 0;
    StopRule stop{}; ///< as it is rendered by default
};

// The skirt of skirt.h.
// \param fabric `ggx` or `yarn`
Scene skirt(const std::string &fabric, int lights, int size);

// The skirt in both fabrics with direct light alone and with three bounces in an even environment;
// the three-softbox studio; the sample dress as it is tried on.
// \param scenes the folder of the scene files of the benchmarks
std::vector<RenderScene> render_scenes(const std::filesystem::path &scenes);

// Sample dresses as they are looked at: tried on in white and in crimson, printed, and in the
// studio of the benchmarks.
std::vector<RenderScene> denoised_scenes(const std::filesystem::path &scenes);

// The sample scenes with a quarter of their width, with the stop rules of their default quality:
// the sample dress as it is tried on in two colours, the scene files of the samples, and the
// studio.
std::vector<RenderScene> speck_scenes(const std::filesystem::path &scenes);

} // namespace tsuya::bench

#pragma once
/// \file
/// The light of one view: its exposures merged, and the means of its patches.

#include <map>
#include <optional>
#include <vector>

#include "frame_patches.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/lab/patch_window.h"

namespace tsuya::lab {

/// The patches of one colour.
struct PatchLight {
    PatchMean middle{};
    PatchMean all{};    ///< mean of all patches, for what has no texture: rate and sigma
    double texture = 0; ///< standard error of `middle` from its place on the cloth, DN a second
    double uneven = 1;  ///< larger over smaller light of two opposite sides, 1 for one patch
};

/// One view.
struct ViewLight {
    std::size_t view = 0;
    DirectionPair directions{};
    double time_s = 0; ///< middle of the exposures, weighted by their length
    int strike = 0;
    std::vector<PatchLight> colours{};
};

/// Dark frames by exposure, each one colour after the other.
using DarkFrames = std::map<double, std::vector<DarkPixels>>;

/// The standard error of one mean among several of a texture: the root of their variance without
/// that of noise. 0 for fewer than 4, and where noise explains the spread of whole repeats.
double texture_error(const std::vector<PatchMean> &patches, bool whole_repeats);

/// Merges the exposures of a view. `frames[k]` is of the planned exposure that `dark` knows; where
/// it has none, `sensor.black` is taken. Window: weights of the patch.
std::vector<PatchLight> light_of(const std::vector<FramePatches> &frames, const DarkFrames &dark,
                                 const Sensor &sensor, const PatchGrid &grid,
                                 const PatchWindow &window);

} // namespace tsuya::lab

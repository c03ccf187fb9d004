#pragma once
/// \file
/// The light of one view: its exposures merged, and the means of its patches.

#include <vector>

#include "flat_field.h"
#include "lamp_monitor.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/lab/patch_window.h"

namespace tsuya::lab {

/// The patches of one colour.
struct PatchLight {
    PatchMean middle{};
    PatchMean all{};    ///< mean of all patches, for what has no texture: rate and sigma
    double texture = 0; ///< standard error of `middle` from its place on the cloth, DN a second
    double lamp = 0;    ///< the same from the monitor's noise
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

/// The standard error of one mean among several of a texture: the root of their variance without
/// that of noise. 0 for fewer than 4, and where noise explains the spread of whole repeats.
double texture_error(const std::vector<PatchMean> &patches, bool whole_repeats);

/// What is known beside the frames of a view.
struct LightSettings {
    const DarkFrames &dark; ///< where it has no frame of an exposure, `sensor.black` is taken
    const Sensor &sensor;
    const FlatField &flat;
    const PatchWindow &window; ///< weights of the patch
};

/// Merges the exposures of a view. `shares[colour][frame]`: an exposure counts as long as the lamp
/// gave light in it.
std::vector<PatchLight> light_of(const std::vector<FramePatches> &frames,
                                 const std::vector<std::vector<LampShare>> &shares,
                                 const LightSettings &settings);

} // namespace tsuya::lab

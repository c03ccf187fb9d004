#pragma once
/// \file
/// Whether the channels of a render are enough for the colours of its scene.

#include <vector>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

/// A warning for each colour of a cloth or print that the render's channels show with more than
/// one CIEDE2000 (see channel_error), with the number of channels that would do. None where the
/// channels are depths of dye: those are exact at 1 nm.
std::vector<Problem> channel_warnings(const Scene &scene, const RenderSettings &settings);

} // namespace tsuya::scene

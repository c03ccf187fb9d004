#pragma once
/// \file
/// The rules of a camera alone.

#include "tsuya/sdk/camera.h"

namespace tsuya::detail {

/// Throws Error with every rule that a camera breaks, as check_scene.
void check_camera(const Camera &camera);

} // namespace tsuya::detail

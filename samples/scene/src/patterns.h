#pragma once
// From the pictures of patterns to the prints of a scene.

#include <vector>

#include "tsuya/scene/pattern_entry.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// Makes the patterns the prints of the scene, in their order, and the opacities its own; reads each
// picture once. Throws Error at the path of a picture.
void add_pictures(const std::vector<PatternEntry> &patterns,
                  const std::vector<OpacityEntry> &opacities, Scene &scene);

} // namespace tsuya::scene

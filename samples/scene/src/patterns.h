#pragma once
// From the pictures of patterns to the prints of a scene.

#include <vector>

#include "tsuya/scene/pattern_entry.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// Makes the patterns the prints of the scene, in their order; reads each picture once. Throws Error
// at the path of a picture.
void add_prints(const std::vector<PatternEntry> &patterns, Scene &scene);

} // namespace tsuya::scene

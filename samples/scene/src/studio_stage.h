#pragma once
// A studio put into a scene.

#include <string>
#include <vector>

#include "tsuya/scene/studio_preset.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// The groups of a studio that something shines in: its lights, and its environment where the scene
// takes it.
std::vector<StudioGroup> lit_groups(const Studio &studio, bool environment);

// Adds the lights of a studio about points, in groups of their names; its environment and its
// backdrop where the scene is to have them. \param own_lamps of the scene's groups, in their order;
// grows with them
void add_studio_to(Scene &scene, std::vector<std::string> &own_lamps, const std::string &name,
                   const std::vector<glm::dvec3> &points, double azimuth, bool backdrop);

} // namespace tsuya::scene

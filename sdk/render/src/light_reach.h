#pragma once
// What a light can give to the surfaces of a scene.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/light.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {

// A box around all surfaces that objects have.
struct SceneBox {
    glm::dvec3 low, high;
};

SceneBox box_of(const Scene &scene);

// Bounds of the irradiance that a light gives to planes that face it anywhere in a box, were
// nothing in its way.
struct LightReach {
    double least = 0; // 0 where a bound is not known
    double most = 0;  // infinite where the box reaches to the light
};

LightReach reach_of(const Light &light, const SceneBox &box);

// Of each light of a scene why it is of no account: it shines past all surfaces, or what it gives
// is lost in the rounding of what another light of its group gives everywhere, but for shadows.
// Empty for lights that count, and for those that do not shine.
std::vector<std::string> out_of_reach(const Scene &scene);

} // namespace tsuya

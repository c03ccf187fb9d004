#pragma once
// What the camera sees of a weave.

#include <optional>

#include <glm/glm.hpp>

#include "traced_scene.h"
#include "tsuya/sdk/near_yarn.h"

namespace tsuya {

// The place of the weave at a point that a ray of the camera hit; empty where its yarns are not
// told apart, and where the surface has no places on the cloth.
std::optional<NearPlace> near_place(const TracedScene &scene, const glm::vec3 &direction,
                                    const Hit &hit, const SurfacePoint &point);

} // namespace tsuya

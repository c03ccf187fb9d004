#pragma once
// Tessellation as fine as the camera of a scene needs.

#include <vector>

#include "scene_meshes.h"
#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

// What the camera and the lights of a scene ask of a mesh with a tolerance in pixels. The points
// are those of all meshes, as they stand in the scene; half the distance of the nearest that is in
// the picture is taken to be free.
garment::ViewTolerance view_of(const Scene &scene, const std::vector<glm::dvec3> &points,
                               const SceneMesh &mesh);

} // namespace tsuya::scene

#pragma once
/// \file
/// A camera that moves through a scene.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/camera.h"

namespace tsuya::scene {

/// Where a camera is at one time.
struct CameraKey {
    double at = 0; ///< share of the sequence: 0 is its first frame, 1 its last
    glm::dvec3 eye{0, 1, 3};
    glm::dvec3 target{0, 1, 0};
    double vertical_angle = 0.6; ///< see Camera
};

/// The camera between keys: `camera` with eye, target and angle of their time. Each follows a cubic
/// through its keys whose slope at a key is that of the parabola through the key and its
/// neighbours, so that the camera moves smoothly at any spacing; it rests at both ends.
/// \param keys two or more, `at` rising from 0 to 1
/// \param at 0 to 1
Camera camera_between(const std::vector<CameraKey> &keys, Camera camera, double at);

/// The share of the sequence of a frame: 0 for the first of `frames` and 1 for the last.
double share_of_frame(std::size_t frame, std::size_t frames);

} // namespace tsuya::scene

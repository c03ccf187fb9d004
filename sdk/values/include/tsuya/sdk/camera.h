#pragma once
/// \file
/// From where a scene is looked at.

#include <glm/glm.hpp>

namespace tsuya {

/// A pinhole camera.
struct Camera {
    glm::dvec3 eye{0, 1, 3};
    glm::dvec3 target{0, 1, 0};
    glm::dvec3 up{0, 1, 0};
    double vertical_angle = 0.6; ///< full angle of view, radians, in (0, pi)
    int width = 800;
    int height = 1000;
};

} // namespace tsuya

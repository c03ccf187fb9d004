#include "tsuya/sdk/camera.h"

#include <cmath>

namespace tsuya {

CameraAxes axes_of(const Camera &camera) {
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    return {right, glm::cross(right, forward), forward};
}

double pixel_width(const Camera &camera, double distance) {
    if (camera.orthographic_height)
        return *camera.orthographic_height / camera.height;
    return 2 * std::tan(0.5 * camera.vertical_angle) / camera.height * distance;
}

double distance_along_view(const Camera &camera, const glm::dvec3 &point) {
    return glm::dot(point - camera.eye, glm::normalize(camera.target - camera.eye));
}

double focus_distance(const Camera &camera) {
    return camera.lens && camera.lens->focus_distance ? *camera.lens->focus_distance
                                                      : glm::distance(camera.eye, camera.target);
}

double aperture_radius(const Camera &camera) {
    if (!camera.lens)
        return 0;
    const double to_sensor =
        0.5 * camera.lens->sensor_height / std::tan(0.5 * camera.vertical_angle);
    const double focal_length = 1 / (1 / focus_distance(camera) + 1 / to_sensor);
    return 0.5 * focal_length / camera.lens->f_number;
}

} // namespace tsuya

#include "limit/view_tolerance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tsuya::garment {
ViewNeed::ViewNeed(const ViewTolerance &view) : view_(view) {
    const Camera &camera = view.camera;
    const double tan_y = std::tan(0.5 * camera.vertical_angle);
    const double tan_x = tan_y * camera.width / camera.height;
    pixel_ = view.pixels * 2.0 * tan_y / camera.height;
    const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up));
    const glm::dvec3 up = glm::cross(right, forward);
    plane_ = {forward, glm::normalize(tan_x * forward + right),
              glm::normalize(tan_x * forward - right), glm::normalize(tan_y * forward + up),
              glm::normalize(tan_y * forward - up)};
}

double ViewNeed::footprint(double distance) const {
    return pixel_ * std::max(distance, view_.nearest);
}

double ViewNeed::tolerance(const glm::dvec3 &centre, double radius) const {
    if (view_.light_from_everywhere || seen(centre, radius))
        return footprint(glm::distance(centre, view_.camera.eye) - radius);
    double least = std::numeric_limits<double>::infinity();
    for (const ViewLight &light : view_.lights)
        least = std::min(least, shadow_tolerance(centre, radius, light));
    return least;
}

bool ViewNeed::seen(const glm::dvec3 &centre, double radius) const {
    return std::all_of(plane_.begin(), plane_.end(), [&](const glm::dvec3 &n) {
        return glm::dot(n, centre - view_.camera.eye) >= -radius;
    });
}

double ViewNeed::shadow_tolerance(const glm::dvec3 &centre, double radius,
                                  const ViewLight &light) const {
    // The shadow lies about light + k (centre - light), k >= 1, and is k radius + (k - 1)
    // light.radius wide: the part of it inside all planes.
    const glm::dvec3 away = centre - light.centre, eye = view_.camera.eye - light.centre;
    double first = 1.0, last = std::numeric_limits<double>::infinity();
    for (const glm::dvec3 &n : plane_) {
        const double start = -glm::dot(n, eye) - light.radius;
        const double slope = glm::dot(n, away) + radius + light.radius;
        if (slope > 0.0)
            first = std::max(first, -start / slope);
        else if (slope < 0.0)
            last = std::min(last, -start / slope);
        else if (start < 0.0)
            last = 0.0;
    }
    if (first > last)
        return std::numeric_limits<double>::infinity();
    // A departure of the face is k times as large in its shadow. Seen from the eye it is largest
    // where the distance over k is least: |away - eye / k|, less the width.
    const double nearest = glm::dot(away, eye) / glm::dot(eye, eye);
    const double share =
        std::clamp(std::isfinite(nearest) ? nearest : 1.0, 1.0 / last, 1.0 / first);
    const double distance = glm::length(away - share * eye) - radius - (1.0 - share) * light.radius;
    return std::max(pixel_ * distance, share * footprint(0.0));
}

} // namespace tsuya::garment

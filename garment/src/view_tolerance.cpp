#include "view_tolerance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tsuya::garment {
namespace {

/// Below this share of a metre nothing is taken to be nearer to the eye.
constexpr double kNearest = 1e-3;

} // namespace

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

double ViewNeed::tolerance(const glm::dvec3 &centre, double radius) const {
    const double distance = glm::distance(centre, view_.camera.eye) - radius;
    if (seen(centre, radius))
        return footprint(std::max(distance, kNearest));
    double least = std::numeric_limits<double>::infinity();
    for (const glm::dvec3 &light : view_.lights)
        least = std::min(least, shadow_tolerance(centre, radius, light));
    return least;
}

bool ViewNeed::seen(const glm::dvec3 &centre, double radius) const {
    return std::all_of(plane_.begin(), plane_.end(), [&](const glm::dvec3 &n) {
        return glm::dot(n, centre - view_.camera.eye) >= -radius;
    });
}

double ViewNeed::shadow_tolerance(const glm::dvec3 &centre, double radius,
                                  const glm::dvec3 &light) const {
    // The part of the ray away from the light that lies inside all planes, which are moved out by
    // the radius; the shadow of a near light widens with the distance.
    const glm::dvec3 away = centre - light;
    const double length = std::max(glm::length(away), kNearest);
    double begin = 0.0, end = std::numeric_limits<double>::infinity();
    for (const glm::dvec3 &n : plane_) {
        const double start = glm::dot(n, centre - view_.camera.eye) + radius;
        const double slope = glm::dot(n, away) + radius;
        if (slope > 0.0)
            begin = std::max(begin, -start / slope);
        else if (slope < 0.0)
            end = std::min(end, -start / slope);
        else if (start < 0.0)
            end = -1.0;
    }
    if (begin > end)
        return std::numeric_limits<double>::infinity();
    // Where the shadow is nearest to the eye, less its own width there; it is a departure of the
    // face seen through the light, 1 + t times as large.
    const double closest = glm::dot(view_.camera.eye - centre, away) / (length * length);
    const double t = std::clamp(closest, begin, end);
    const double distance = glm::distance(centre + t * away, view_.camera.eye);
    return footprint(std::max(distance - (1.0 + t) * radius, kNearest)) / (1.0 + t);
}

} // namespace tsuya::garment

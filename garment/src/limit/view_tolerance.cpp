#include "limit/view_tolerance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tsuya::garment {

ViewNeed::ViewNeed(const ViewTolerance &view)
    : view_(view), pixel_(view.pixels * pixel_width(view.camera, 1)),
      aperture_(aperture_radius(view.camera)) {
    const CameraAxes axes = axes_of(view.camera);
    if (view.camera.orthographic_height)
        bound_parallel(axes);
    else
        bound_perspective(axes);
}

void ViewNeed::bound_perspective(const CameraAxes &axes) {
    const Camera &camera = view_.camera;
    const double tan_y = std::tan(0.5 * camera.vertical_angle);
    const double tan_x = tan_y * camera.width / camera.height;
    const glm::dvec3 forward = axes.forward;
    // Off the axis a pixel is narrower, seen from the eye by the square of the cosine
    if (camera.shift != glm::dvec2(0)) {
        const glm::dvec3 corner(1, tan_x * (1 + 2 * std::abs(camera.shift.x)),
                                tan_y * (1 + 2 * std::abs(camera.shift.y)));
        pixel_ /= glm::dot(corner, corner);
    }
    const double right = tan_x * (1 + 2 * camera.shift.x), left = tan_x * (1 - 2 * camera.shift.x);
    const double top = tan_y * (1 + 2 * camera.shift.y), bottom = tan_y * (1 - 2 * camera.shift.y);
    // Rays from the rim of an aperture of radius r through a place that is sharp, at a distance f,
    // leave the pyramid of the eye by at most r (1 + z / f) at the distance z
    const glm::dvec3 opening =
        aperture_ > 0 ? aperture_ / focus_distance(camera) * forward : glm::dvec3(0);
    const auto side = [&](const glm::dvec3 &normal) {
        if (aperture_ > 0) {
            const glm::dvec3 opened = glm::normalize(normal) + opening;
            plane_.push_back({glm::normalize(opened), aperture_ / glm::length(opened)});
        } else {
            plane_.push_back({glm::normalize(normal), 0});
        }
    };
    plane_.push_back({forward, 0});
    side(left * forward + axes.right);
    side(right * forward - axes.right);
    side(bottom * forward + axes.up);
    side(top * forward - axes.up);
}

void ViewNeed::bound_parallel(const CameraAxes &axes) {
    const Camera &camera = view_.camera;
    const double half_height = 0.5 * *camera.orthographic_height;
    const double half_width = half_height * camera.width / camera.height;
    plane_ = {{axes.forward, 0},
              {axes.right, half_width * (1 - 2 * camera.shift.x)},
              {-axes.right, half_width * (1 + 2 * camera.shift.x)},
              {axes.up, half_height * (1 - 2 * camera.shift.y)},
              {-axes.up, half_height * (1 + 2 * camera.shift.y)}};
}

double ViewNeed::footprint(double distance) const {
    if (view_.camera.orthographic_height)
        return pixel_;
    return pixel_ * std::max(distance - aperture_, view_.nearest);
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
    return std::all_of(plane_.begin(), plane_.end(), [&](const Plane &plane) {
        return glm::dot(plane.normal, centre - view_.camera.eye) + plane.at_eye >= -radius;
    });
}

double ViewNeed::shadow_tolerance(const glm::dvec3 &centre, double radius,
                                  const ViewLight &light) const {
    // The shadow lies about light + k (centre - light), k >= 1, and is k radius + (k - 1)
    // light.radius wide: the part of it inside all planes.
    const glm::dvec3 away = centre - light.centre, eye = view_.camera.eye - light.centre;
    double first = 1.0, last = std::numeric_limits<double>::infinity();
    for (const Plane &plane : plane_) {
        const double start = plane.at_eye - glm::dot(plane.normal, eye) - light.radius;
        const double slope = glm::dot(plane.normal, away) + radius + light.radius;
        if (slope > 0.0)
            first = std::max(first, -start / slope);
        else if (slope < 0.0)
            last = std::min(last, -start / slope);
        else if (start < 0.0)
            last = 0.0;
    }
    if (first > last)
        return std::numeric_limits<double>::infinity();
    // A departure of the face is k times as large in its shadow
    if (view_.camera.orthographic_height)
        return footprint(0.0) / std::min(last, std::max(first, (glm::length(eye) + view_.farthest) /
                                                                   glm::length(away)));
    // Seen from the eye it is largest where the distance over k is least: |away - eye / k|, less
    // the width.
    const double nearest = glm::dot(away, eye) / glm::dot(eye, eye);
    const double share =
        std::clamp(std::isfinite(nearest) ? nearest : 1.0, 1.0 / last, 1.0 / first);
    const double distance =
        glm::length(away - share * eye) - radius - (1.0 - share) * light.radius - share * aperture_;
    return std::max(pixel_ * distance, share * footprint(0.0));
}

} // namespace tsuya::garment

#include "camera_rays.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {

CameraRays::CameraRays(const Camera &camera, const glm::dvec3 &centre)
    : width_(static_cast<float>(camera.width)), height_(static_cast<float>(camera.height)),
      parallel_(camera.orthographic_height.has_value()), has_lens_(camera.lens.has_value()) {
    const auto [aside, above, ahead] = axes_of(camera);
    const double half_height =
        parallel_ ? 0.5 * *camera.orthographic_height : std::tan(0.5 * camera.vertical_angle);
    const glm::dvec3 right = aside * (half_height * camera.width / camera.height);
    const glm::dvec3 up = above * half_height;
    const glm::dvec3 moved = 2 * camera.shift.x * right + 2 * camera.shift.y * up;
    eye_ = camera.eye - centre + (parallel_ ? moved : glm::dvec3(0));
    forward_ = ahead + (parallel_ ? glm::dvec3(0) : moved);
    right_ = right;
    up_ = up;
    const auto pixel = static_cast<float>(2 * half_height / camera.height);
    (parallel_ ? pixel_size_ : pixel_angle_) = pixel;
    if (!has_lens_)
        return;
    focus_ = static_cast<float>(focus_distance(camera));
    aperture_right_ = aperture_radius(camera) * aside;
    aperture_up_ = aperture_radius(camera) * above;
    blades_ = camera.lens->blades;
}

CameraRay CameraRays::through(float x, float y, const Sampler &sampler) const {
    const float a = 2 * x / width_ - 1;
    const float b = 1 - 2 * y / height_;
    if (parallel_)
        return {eye_ + a * right_ + b * up_, forward_};
    const glm::vec3 along = forward_ + a * right_ + b * up_;
    if (!has_lens_)
        return {eye_, glm::normalize(along)};
    // All rays of the place meet in the plane that is sharp
    const glm::vec2 at = on_aperture(sampler.further_pair());
    const glm::vec3 off_axis = at.x * aperture_right_ + at.y * aperture_up_;
    return {eye_ + off_axis, glm::normalize(focus_ * along - off_axis)};
}

// Evenly on the unit disk, or on the polygon in it: on one of its triangles about the middle.
glm::vec2 CameraRays::on_aperture(glm::vec2 u) const {
    const float radius = std::sqrt(u.x);
    const auto on_circle = [](float turns) {
        const float angle = 2 * static_cast<float>(kPi) * turns;
        return glm::vec2(std::sin(angle), std::cos(angle));
    };
    if (blades_ == 0)
        return radius * on_circle(u.y);
    const auto count = static_cast<float>(blades_);
    const float corner = std::min(std::floor(u.y * count), count - 1);
    return radius * glm::mix(on_circle(corner / count), on_circle((corner + 1) / count),
                             u.y * count - corner);
}

} // namespace tsuya

#include "tsuya/scene/studio.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

constexpr int kBendSegments = 64;

struct ProfilePoint {
    double depth, height;      ///< depth from the centre away from the open side
    double normal_z, normal_y; ///< normal_z towards the open side
};

/// Floor, quarter circle, wall.
std::vector<ProfilePoint> profile_of(const Cyclorama &c) {
    std::vector<ProfilePoint> profile{{-c.front, 0, 0, 1}};
    for (int i = 0; i <= kBendSegments; ++i) {
        const double angle = 0.5 * kPi * i / kBendSegments;
        profile.push_back({c.back - c.radius + c.radius * std::sin(angle),
                           c.radius - c.radius * std::cos(angle), std::sin(angle),
                           std::cos(angle)});
    }
    profile.push_back({c.back, c.height, 1, 0});
    return profile;
}

void need(bool rule, const char *what, const char *where, const char *accepted) {
    if (!rule)
        throw Error({what, where, accepted});
}

/// How far points may lie from the middle of the view, as shares of half the picture.
struct Reach {
    double low, high;
};

Reach reach_of(double margin, double shift) {
    return {-(1 - margin) + 2 * shift, 1 - margin + 2 * shift};
}

/// Bounds of points along the axes of a camera at the origin, and their mean distance from it.
struct AxialBounds {
    glm::dvec3 lower{std::numeric_limits<double>::max()}, upper{-lower};
    double middle = 0; ///< backwards

    AxialBounds(const std::vector<glm::dvec3> &points, const CameraAxes &axes) {
        for (const glm::dvec3 &p : points) {
            const glm::dvec3 at(glm::dot(p, axes.right), glm::dot(p, axes.up),
                                -glm::dot(p, axes.forward));
            lower = glm::min(lower, at);
            upper = glm::max(upper, at);
            middle += at.z / static_cast<double>(points.size());
        }
    }
};

void place(const CameraAxes &axes, double right, double up, double back, double middle,
           Camera &camera) {
    const glm::dvec3 in_plane = right * axes.right + up * axes.up;
    camera.eye = in_plane - back * axes.forward;
    camera.target = in_plane - middle * axes.forward;
}

/// As near as a perspective sees all points.
void stand_near(const std::vector<glm::dvec3> &points, const Framing &f, const CameraAxes &axes,
                Camera &camera) {
    const double slope = std::tan(0.5 * f.vertical_angle);
    const Reach x_reach = reach_of(f.margin, f.shift.x), y_reach = reach_of(f.margin, f.shift.y);
    const double x_low = slope * x_reach.low * f.width / f.height;
    const double x_high = slope * x_reach.high * f.width / f.height;
    const double y_low = slope * y_reach.low, y_high = slope * y_reach.high;
    // Every point bounds the eye by four planes, e.g. y + slope z <= eye_y + slope eye_z
    constexpr double kLow = -std::numeric_limits<double>::infinity();
    double right = kLow, left = kLow, top = kLow, bottom = kLow;
    for (const glm::dvec3 &p : points) {
        const double x = glm::dot(p, axes.right), y = glm::dot(p, axes.up);
        const double z = -glm::dot(p, axes.forward);
        right = std::max(right, x + x_high * z);
        left = std::max(left, -x - x_low * z);
        top = std::max(top, y + y_high * z);
        bottom = std::max(bottom, -y - y_low * z);
    }
    const double eye_z =
        std::max((right + left) / (x_high - x_low), (top + bottom) / (y_high - y_low));
    const double middle = AxialBounds(points, axes).middle;
    need(eye_z > middle, "the points enclose no space", "camera", "expected points apart");
    place(axes, 0.5 * (right - left - (x_high + x_low) * eye_z),
          0.5 * (top - bottom - (y_high + y_low) * eye_z), eye_z, middle, camera);
}

/// Clear of all points, which parallel rays show in one size from everywhere.
void stand_parallel(const std::vector<glm::dvec3> &points, const Framing &f, const CameraAxes &axes,
                    Camera &camera) {
    const AxialBounds bounds(points, axes);
    const glm::dvec3 size = bounds.upper - bounds.lower;
    const double needed = std::max(size.y, size.x * f.height / f.width) / (1 - f.margin);
    const double height = f.orthographic_height.value_or(needed);
    need(height > 0, "the points enclose no space", "camera", "expected points apart");
    camera.orthographic_height = height;
    const glm::dvec3 middle = 0.5 * (bounds.lower + bounds.upper);
    place(axes, middle.x - f.shift.x * height * f.width / f.height, middle.y - f.shift.y * height,
          bounds.upper.z + height, bounds.middle, camera);
}

} // namespace

glm::dvec3 direction_at(double azimuth, double elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

Surface make_cyclorama(const Cyclorama &c) {
    need(c.width > 0 && c.front > 0 && c.radius > 0 && std::isfinite(c.width + c.front),
         "a length is not above 0", "backdrop", "expected width, front and radius above 0 metres");
    need(c.back > c.radius && c.height > c.radius && std::isfinite(c.back + c.height),
         "the bend does not fit", "backdrop", "expected back and height above the radius");
    const glm::dvec3 front = direction_at(c.azimuth, 0);
    const glm::dvec3 side = glm::cross(glm::dvec3(0, 1, 0), front);
    Surface surface;
    for (const ProfilePoint &p : profile_of(c))
        for (const double s : {-0.5, 0.5}) {
            surface.position.push_back(c.centre + s * c.width * side - p.depth * front +
                                       glm::dvec3(0, p.height, 0));
            surface.normal.emplace_back(p.normal_z * front + glm::dvec3(0, p.normal_y, 0));
        }
    for (std::uint32_t i = 0; i + 2 < surface.position.size(); i += 2) {
        surface.triangle.emplace_back(i, i + 1, i + 3);
        surface.triangle.emplace_back(i, i + 3, i + 2);
    }
    return surface;
}

RectangleLight make_light(const Softbox &box) {
    const glm::dvec3 towards = box.target - box.centre;
    const double distance = glm::length(towards);
    need(std::isfinite(distance), "the light is too far from its target", "softbox",
         "expected centre and target within 1e+09 m");
    need(distance > 0, "the light is at its target", "softbox", "expected centre and target apart");
    need(box.width > 0 && box.height > 0 && std::isfinite(box.width + box.height),
         "the light has no area", "softbox", "expected width and height above 0 metres");
    need(box.strength >= 0 && std::isfinite(box.strength), "the strength is wrong", "softbox",
         "expected a number not below 0");
    const glm::dvec3 normal = towards / distance;
    const glm::dvec3 across = glm::cross(box.up, normal);
    need(glm::length(across) > 1e-9 * glm::length(box.up), "the light looks along its up direction",
         "softbox", "expected another up");
    const glm::dvec3 u = box.width * glm::normalize(across);
    const glm::dvec3 v = box.height * glm::cross(normal, glm::normalize(across));
    RectangleLight light{.corner = box.centre - 0.5 * (u + v),
                         .edge_u = u,
                         .edge_v = v,
                         .radiance = 1,
                         .group = box.group};
    light.radiance = box.strength * kPi / irradiance(light, box.target, -normal);
    return light;
}

Camera frame_points(const std::vector<glm::dvec3> &points, const Framing &f) {
    need(!points.empty(), "there is nothing to frame", "camera", "expected a garment or a body");
    need(f.width > 0 && f.height > 0, "the picture has no pixels", "camera",
         "expected width and height of 1 or more");
    need(f.vertical_angle > 0 && f.vertical_angle < kPi, "the angle of view is wrong", "camera",
         "expected more than 0 and less than 180 degrees");
    need(f.margin >= 0 && f.margin <= 0.9, "the margin is wrong", "camera",
         "expected a share of 0 to 0.9");
    need(std::abs(f.elevation) < 0.5 * kPi, "the elevation is wrong", "camera",
         "expected more than -90 and less than 90 degrees");
    need(!f.orthographic_height || *f.orthographic_height > 0, "the height is wrong", "camera",
         "expected an orthographic height above 0 m");
    const glm::dvec3 back = direction_at(f.azimuth, f.elevation);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), back));
    const CameraAxes axes{right, glm::cross(back, right), -back};
    Camera camera{.vertical_angle = f.vertical_angle,
                  .width = f.width,
                  .height = f.height,
                  .lens = f.lens,
                  .shift = f.shift};
    if (f.orthographic)
        stand_parallel(points, f, axes, camera);
    else
        stand_near(points, f, axes, camera);
    return camera;
}

glm::dvec3 project_point(const Camera &camera, const glm::dvec3 &point) {
    const CameraAxes axes = axes_of(camera);
    const glm::dvec3 offset = point - camera.eye;
    const double distance = glm::dot(offset, axes.forward);
    const double pixels = 1 / pixel_width(camera, distance);
    return {(0.5 - camera.shift.x) * camera.width + glm::dot(offset, axes.right) * pixels,
            (0.5 + camera.shift.y) * camera.height - glm::dot(offset, axes.up) * pixels, distance};
}

} // namespace tsuya::scene

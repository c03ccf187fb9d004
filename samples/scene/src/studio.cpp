#include "tsuya/scene/studio.h"

#include <algorithm>
#include <array>
#include <cmath>

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

/// Right, up and back of a camera, orthonormal.
struct CameraAxes {
    glm::dvec3 right, up, back;
};

CameraAxes axes_of(const glm::dvec3 &back, const glm::dvec3 &up) {
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    return {right, glm::cross(back, right), back};
}

} // namespace

glm::dvec3 direction_of(double azimuth, double elevation) {
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            std::cos(azimuth) * std::cos(elevation)};
}

Surface make_cyclorama(const Cyclorama &c) {
    need(c.width > 0 && c.front > 0 && c.radius > 0 && std::isfinite(c.width + c.front),
         "a length is not above 0", "backdrop", "expected width, front and radius above 0 metres");
    need(c.back > c.radius && c.height > c.radius && std::isfinite(c.back + c.height),
         "the bend does not fit", "backdrop", "expected back and height above the radius");
    const glm::dvec3 front = direction_of(c.azimuth, 0);
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

double irradiance(const RectangleLight &light, const glm::dvec3 &point, const glm::dvec3 &normal) {
    const std::array<glm::dvec3, 4> corners{light.corner, light.corner + light.edge_u,
                                            light.corner + light.edge_u + light.edge_v,
                                            light.corner + light.edge_v};
    glm::dvec3 sum(0);
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - point);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % 4] - point);
        const glm::dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0)
            sum += std::atan2(sine, glm::dot(a, b)) / sine * across;
    }
    return 0.5 * light.radiance * std::abs(glm::dot(sum, normal));
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
    const CameraAxes axes = axes_of(direction_of(f.azimuth, f.elevation), {0, 1, 0});
    const double slope_y = std::tan(0.5 * f.vertical_angle) * (1 - f.margin);
    const double slope_x = slope_y * f.width / f.height;

    // Every point bounds the eye by four planes, e.g. y + slope z <= eye_y + slope eye_z
    constexpr double kLow = -std::numeric_limits<double>::infinity();
    double right = kLow, left = kLow, top = kLow, bottom = kLow, middle = 0;
    for (const glm::dvec3 &p : points) {
        const double x = glm::dot(p, axes.right), y = glm::dot(p, axes.up);
        const double z = glm::dot(p, axes.back);
        right = std::max(right, x + slope_x * z);
        left = std::max(left, -x + slope_x * z);
        top = std::max(top, y + slope_y * z);
        bottom = std::max(bottom, -y + slope_y * z);
        middle += z / static_cast<double>(points.size());
    }
    const double eye_z = std::max((right + left) / (2 * slope_x), (top + bottom) / (2 * slope_y));
    const glm::dvec3 in_plane = 0.5 * (right - left) * axes.right + 0.5 * (top - bottom) * axes.up;
    need(eye_z > middle, "the points enclose no space", "camera", "expected points apart");
    return {.eye = in_plane + eye_z * axes.back,
            .target = in_plane + middle * axes.back,
            .vertical_angle = f.vertical_angle,
            .width = f.width,
            .height = f.height};
}

glm::dvec3 project_point(const Camera &camera, const glm::dvec3 &point) {
    const CameraAxes axes = axes_of(glm::normalize(camera.eye - camera.target), camera.up);
    const glm::dvec3 offset = point - camera.eye;
    const double distance = -glm::dot(offset, axes.back);
    const double pixels = 0.5 * camera.height / (std::tan(0.5 * camera.vertical_angle) * distance);
    return {0.5 * camera.width + glm::dot(offset, axes.right) * pixels,
            0.5 * camera.height - glm::dot(offset, axes.up) * pixels, distance};
}

} // namespace tsuya::scene

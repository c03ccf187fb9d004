// The rules of lights, which a scene has to keep.

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "scene_check.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/scene.h"

namespace tsuya {
namespace {

void need_emission(double value, const char *what, const std::string &where, Problems &problems) {
    problems.need(is_radiance(value), std::string("the ") + what + " is " + plain_number(value),
                  where + "." + what, radiances_text());
}

// \return whether it lies where lights may be
bool need_place(const glm::dvec3 &at, double radius, const std::string &where, Problems &problems) {
    return problems.need(is_length(at) && is_length(glm::dvec3(radius)),
                         "the light lies too far away or is too large", where, lengths_text());
}

void need_direction(const glm::dvec3 &direction, const char *key, const std::string &where,
                    Problems &problems) {
    problems.need(is_length(direction) && glm::length(direction) > 0, "the light has no direction",
                  where + "." + key, "expected a vector that is not 0");
}

void need_radius(double radius, const std::string &where, Problems &problems) {
    problems.need(radius >= 0 && kPi * radius * radius >= kSmallestLight, "the light has no area",
                  where + ".radius",
                  "expected at least " + plain_number(kSmallestLight) + " m2, or a point light");
}

} // namespace

bool is_length(const glm::dvec3 &v) {
    return std::abs(v.x) <= kLargestLength && std::abs(v.y) <= kLargestLength &&
           std::abs(v.z) <= kLargestLength; // false for NaN
}

bool is_radiance(double v) { return v >= 0 && v <= kLargestRadiance; }

std::string plain_number(double v) {
    std::ostringstream text;
    text << v;
    return text.str();
}

std::string lengths_text() {
    return "expected coordinates within " + plain_number(kLargestLength) + " m";
}

std::string radiances_text() { return "expected 0 to " + plain_number(kLargestRadiance); }

void check_light(const RectangleLight &light, const std::string &where, Problems &problems) {
    if (!is_length(light.corner) || !is_length(light.edge_u) || !is_length(light.edge_v))
        problems.need(false, "the light lies too far away or is too large", where, lengths_text());
    else
        problems.need(glm::length(glm::cross(light.edge_u, light.edge_v)) >= kSmallestLight,
                      "the light has no area", where,
                      "expected two edges that are not parallel, and at least " +
                          plain_number(kSmallestLight) + " m2");
    need_emission(light.radiance, "radiance", where, problems);
}

void check_light(const DiskLight &light, const std::string &where, Problems &problems) {
    if (need_place(light.centre, light.radius, where, problems))
        need_radius(light.radius, where, problems);
    need_direction(light.direction, "direction", where, problems);
    need_emission(light.radiance, "radiance", where, problems);
}

void check_light(const SphereLight &light, const std::string &where, Problems &problems) {
    if (need_place(light.centre, light.radius, where, problems))
        need_radius(light.radius, where, problems);
    need_emission(light.radiance, "radiance", where, problems);
}

void check_light(const PointLight &light, const std::string &where, Problems &problems) {
    need_place(light.position, 0, where, problems);
    need_direction(light.direction, "direction", where, problems);
    problems.need(light.cone_angle > 0 && light.cone_angle <= kPi, "the angle of the cone is wrong",
                  where + ".cone_angle", "expected more than 0 and up to 180 degrees");
    problems.need(light.full_angle >= 0 && light.full_angle <= light.cone_angle,
                  "the angle of full intensity is wrong", where + ".full_angle",
                  "expected 0 up to the angle of the cone");
    need_emission(light.intensity, "intensity", where, problems);
    if (!light.profile)
        return;
    need_direction(light.zero_plane, "zero_plane", where, problems);
    const auto &[vertical, horizontal, candela] = *light.profile;
    const auto rises = [](const std::vector<double> &list, double last) {
        return !list.empty() && list.front() >= 0 && list.back() <= last + 1e-9 &&
               std::is_sorted(list.begin(), list.end(), std::less_equal<>());
    };
    problems.need(
        rises(vertical, kPi) && rises(horizontal, 2 * kPi) && vertical.size() >= 2 &&
            candela.size() == vertical.size() * horizontal.size() &&
            std::all_of(candela.begin(), candela.end(),
                        [&](double v) { return v >= 0 && is_radiance(v * light.intensity); }),
        "the profile is wrong", where + ".profile",
        "expected rising angles, and an intensity of 0 to " + plain_number(kLargestRadiance) +
            " for each pair of them");
}

void check_light(const SunLight &light, const std::string &where, Problems &problems) {
    need_direction(light.to_light, "to_light", where, problems);
    problems.need(light.angular_radius >= 0 && light.angular_radius <= kHalfPi,
                  "the angular radius is wrong", where + ".angular_radius",
                  "expected 0 to 90 degrees");
    need_emission(light.irradiance, "irradiance", where, problems);
}

} // namespace tsuya

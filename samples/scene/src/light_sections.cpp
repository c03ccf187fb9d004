// The lights of a scene file.

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_reader.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light_group.h"

namespace tsuya::scene {
namespace {

// What a light shines at where its section does not say.
constexpr glm::dvec3 kTarget{0, 1, 0};
// Of the sun's disc seen from the earth.
constexpr double kSunDiameterDeg = 0.533;

} // namespace

LightGroupIndex SceneReader::group(const Section &section, const std::string &otherwise) {
    const std::string name = section.text("group").value_or(otherwise);
    auto &groups = file_.light_groups;
    note(section, "group", [&] { check_light_group(name, "group"); });
    const auto found = std::find(groups.begin(), groups.end(), name);
    const auto index = static_cast<std::uint32_t>(found - groups.begin());
    if (found == groups.end())
        groups.push_back(name);
    return {index};
}

void SceneReader::read_own_lamp(const Section &section, LightGroupIndex group) {
    file_.own_lamps.resize(file_.light_groups.size());
    const auto lamp = section.text("lamp");
    if (!lamp)
        return;
    note(section, "lamp", [&] { parse_lamp(*lamp, folder_); });
    const std::string spec = parse_spectrum_file_spec(*lamp) ? (folder_ / *lamp).string() : *lamp;
    std::string &known = file_.own_lamps[group.value];
    if (!known.empty() && known != spec)
        section.problem("lamp", "the group has the lamp " + known + " already",
                        "expected one lamp for a group");
    known = spec;
}

void SceneReader::read_units() {
    if (const auto units = root_.section("units"))
        white_lux_ = units->number("white_lux", kSmallest, 1e9).value_or(white_lux_);
}

void SceneReader::read_lights() {
    if (const auto lights = root_.section("lights"))
        for (const auto &[name, section] : lights->sections()) {
            names_light_ = true;
            read_light(name, section);
        }
}

void SceneReader::read_light(const std::string &name, const Section &section) {
    const std::vector<std::string> kinds{"rectangle", "disk", "sphere", "point",
                                         "spot",      "ies",  "sun"};
    std::string kind = section.text("type").value_or("rectangle");
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
        section.problem("type", "no type of light '" + kind + "'", accepted_names(kind, kinds));
        kind = "rectangle";
    }
    const bool faces = kind == "rectangle" || kind == "disk" || kind == "spot" || kind == "ies";
    const glm::dvec3 target = faces ? section.vector("target").value_or(kTarget) : kTarget;
    note(section, kind == "sun" ? "elevation_deg" : "centre", [&] {
        Light light;
        if (kind == "rectangle")
            light = read_rectangle(section, target);
        else if (kind == "disk")
            light = read_disk(section, target);
        else if (kind == "sphere")
            light = read_sphere(section);
        else if (kind == "sun")
            light = read_sun(section);
        else if (kind == "spot")
            light = read_spot(section, target);
        else if (kind == "ies")
            light = read_luminaire(section, target);
        else
            light = read_point(section);
        read_strength(section, target, light);
        std::visit(
            [&](auto &l) {
                l.name = name;
                l.group = group(section, name);
                read_own_lamp(section, l.group);
            },
            light);
        file_.lights.push_back(std::move(light));
        file_.light_places.push_back(section.where());
    });
}

glm::dvec3 SceneReader::centre_of(const Section &section) {
    if (!section.has("centre"))
        section.problem("centre", "'centre' is missing", "expected such as [-2, 2.5, 2]");
    return section.vector("centre").value_or(Softbox{}.centre);
}

glm::dvec3 SceneReader::facing(const glm::dvec3 &centre, const glm::dvec3 &target) {
    const glm::dvec3 towards = target - centre;
    const double distance = glm::length(towards);
    if (!std::isfinite(distance) || !(distance > 0))
        throw Error(
            {distance > 0 ? "the light is too far from its target" : "the light is at its target",
             "", "expected centre and target apart, within 1e+09 m"});
    return towards / distance;
}

LightBehaviour SceneReader::read_behaviour(const Section &section) {
    return {.visible = section.flag("visible").value_or(false),
            .blocks = section.flag("blocks").value_or(false),
            .shadows = section.flag("shadows").value_or(true)};
}

RectangleLight SceneReader::read_rectangle(const Section &section, const glm::dvec3 &target) {
    const Softbox box{.centre = centre_of(section),
                      .target = target,
                      .up = section.vector("up").value_or(Softbox{}.up),
                      .width = section.number("width", kSmallest, kLargest).value_or(1),
                      .height = section.number("height", kSmallest, kLargest).value_or(1)};
    RectangleLight light = make_light(box);
    light.behaviour = read_behaviour(section);
    return light;
}

DiskLight SceneReader::read_disk(const Section &section, const glm::dvec3 &target) {
    const glm::dvec3 centre = centre_of(section);
    return {.centre = centre,
            .direction = facing(centre, target),
            .radius = section.number("radius", kSmallest, kLargest).value_or(0.5),
            .behaviour = read_behaviour(section)};
}

SphereLight SceneReader::read_sphere(const Section &section) {
    return {.centre = centre_of(section),
            .radius = section.number("radius", kSmallest, kLargest).value_or(0.1),
            .behaviour = read_behaviour(section)};
}

PointLight SceneReader::read_point(const Section &section) {
    return {.position = centre_of(section), .shadows = section.flag("shadows").value_or(true)};
}

PointLight SceneReader::read_spot(const Section &section, const glm::dvec3 &target) {
    PointLight light = read_point(section);
    light.direction = facing(light.position, target);
    light.cone_angle = 0.5 * section.number("cone_deg", 0.1, 360).value_or(40) * kDegree;
    light.full_angle = light.cone_angle * (1 - section.number("falloff", 0, 1).value_or(0.3));
    return light;
}

PointLight SceneReader::read_luminaire(const Section &section, const glm::dvec3 &target) {
    PointLight light = read_point(section);
    light.direction = facing(light.position, target);
    const double turn = section.number("turn_deg", -360, 360).value_or(0) * kDegree;
    // About the axis from where the front (+z) is; for one that shines along z, from the top
    const glm::dvec3 up =
        std::abs(light.direction.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 zero = glm::normalize(up - glm::dot(up, light.direction) * light.direction);
    light.zero_plane = std::cos(turn) * zero + std::sin(turn) * glm::cross(zero, light.direction);
    if (const auto file = existing_file(section, "profile", true); is_file(file))
        note(section, "profile", [&] { light.profile = read_ies(file); });
    return light;
}

SunLight SceneReader::read_sun(const Section &section) {
    return {.to_light =
                direction_of(section.number("azimuth_deg", -360, 360).value_or(-40) * kDegree,
                             section.number("elevation_deg", -90, 90).value_or(45) * kDegree),
            .angular_radius =
                0.5 * section.number("diameter_deg", 0, 180).value_or(kSunDiameterDeg) * kDegree,
            .visible = section.flag("visible").value_or(false),
            .shadows = section.flag("shadows").value_or(true)};
}

void SceneReader::read_strength(const Section &section, const glm::dvec3 &target, Light &light) {
    const auto place = place_of(light);
    std::vector<const char *> units{"strength", "lux"};
    if (place)
        units.push_back("lumen");
    const auto *const point = std::get_if<PointLight>(&light);
    if (point && !point->profile)
        units.push_back("candela");
    else if (place && !point)
        units.push_back("radiance");
    const char *unit = nullptr;
    double value = 1;
    for (const char *const key : units)
        if (const auto given = section.number(key, 0, 1e9)) {
            if (unit)
                section.problem(key, std::string(unit) + " and " + key + " are both given",
                                "expected one of them");
            unit = key;
            value = *given;
        }
    // A profile has candelas of its own
    const std::string_view given = unit ? unit : (point && point->profile ? "candela" : "strength");
    const double unit_of_lux = kPi / white_lux_; // see light.h
    double &emission = emission_of(light);
    emission = 1;
    if (given == "radiance") {
        emission = value;
    } else if (given == "candela") {
        emission = value * unit_of_lux;
    } else if (given == "lumen") {
        emission = value * unit_of_lux / flux(light);
    } else {
        const glm::dvec3 at = place ? section.vector("at").value_or(target) : kTarget;
        const glm::dvec3 to_light = place ? place->centre - at : std::get<SunLight>(light).to_light;
        const double distance = glm::length(to_light);
        const double unscaled = distance > 0 && (!place || distance > place->radius ||
                                                 !std::holds_alternative<SphereLight>(light))
                                    ? irradiance(light, at, to_light / distance)
                                    : 0;
        if (!(unscaled > 0))
            return section.problem(given, "the light does not reach the point of this strength",
                                   "expected another 'at', or another unit");
        emission = value * (given == "lux" ? unit_of_lux : kPi) / unscaled;
    }
}

} // namespace tsuya::scene

// The lights of a scene file.

#include <algorithm>
#include <array>
#include <cmath>

#include "scene_reader.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/spectrum_file.h"
#include "tsuya/scene/own_lamps.h"
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
    const std::string spec = parse_spectrum_file_spec(*lamp) ? (folder_ / *lamp).string() : *lamp;
    std::string &own = file_.own_lamps[group.value];
    const std::string of_studio = lamp_of_studio(file_.light_groups[group.value]);
    const std::string known = own.empty() ? of_studio : own;
    note(section, "lamp", [&] {
        const NamedLamp read = find_lamp(spec);
        if (known.empty())
            return;
        const NamedLamp other = find_lamp(known);
        if (read.spectrum != other.spectrum || read.factor != other.factor)
            section.problem("lamp",
                            "the group has the lamp " + known +
                                (known == of_studio ? " of the studio" : " already"),
                            "expected one lamp for a group, or another group");
    });
    own = spec;
}

std::string SceneReader::lamp_of_studio(const std::string &group) const {
    const auto found = std::ranges::find(studio_groups_, group, &StudioGroup::name);
    return found == studio_groups_.end() ? "" : found->lamp;
}

void SceneReader::check_own_lamps() {
    const bool wanted = std::ranges::find(file_.output.lamps, kOwnLamps, &NamedLamp::name) !=
                        file_.output.lamps.end();
    file_.own_lamps.resize(file_.light_groups.size());
    for (std::size_t g = 0; wanted && g < file_.light_groups.size(); ++g) {
        const std::string &group = file_.light_groups[g];
        if (file_.own_lamps[g].empty() && lamp_of_studio(group).empty())
            root_.section("output")->problem("lamps",
                                             "light group '" + group + "' has no lamp of its own",
                                             "expected lamp = \"D65\", say, beside its light");
    }
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
    // Every key is read before a light can be refused, so that none is unknown for it
    const LightGroupIndex in_group = group(section, name);
    read_own_lamp(section, in_group);
    const GivenStrength strength = read_strength(section, kind);
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
        give_strength(section, strength, target, light);
        std::visit(
            [&](auto &l) {
                l.name = name;
                l.group = in_group;
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
    const LightBehaviour behaviour = read_behaviour(section);
    const Softbox box{.centre = centre_of(section),
                      .target = target,
                      .up = section.vector("up").value_or(Softbox{}.up),
                      .width = section.number("width", kSmallest, kLargest).value_or(1),
                      .height = section.number("height", kSmallest, kLargest).value_or(1)};
    RectangleLight light = make_light(box);
    light.behaviour = behaviour;
    return light;
}

DiskLight SceneReader::read_disk(const Section &section, const glm::dvec3 &target) {
    DiskLight light{.centre = centre_of(section),
                    .radius = section.number("radius", kSmallest, kLargest).value_or(0.5),
                    .behaviour = read_behaviour(section)};
    light.direction = facing(light.centre, target);
    return light;
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
    light.cone_angle = 0.5 * section.number("cone_deg", 0.1, 360).value_or(40) * kDegree;
    light.full_angle = light.cone_angle * (1 - section.number("falloff", 0, 1).value_or(0.3));
    light.direction = facing(light.position, target);
    return light;
}

PointLight SceneReader::read_luminaire(const Section &section, const glm::dvec3 &target) {
    PointLight light = read_point(section);
    const double turn = section.number("turn_deg", -360, 360).value_or(0) * kDegree;
    if (const auto file = existing_file(section, "profile", true); is_file(file))
        note(section, "profile", [&] { light.profile = read_ies(file); });
    light.direction = facing(light.position, target);
    // About the axis from where the front (+z) is; for one that shines along z, from the top
    const glm::dvec3 up =
        std::abs(light.direction.z) < 0.999 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
    const glm::dvec3 zero = glm::normalize(up - glm::dot(up, light.direction) * light.direction);
    light.zero_plane = std::cos(turn) * zero + std::sin(turn) * glm::cross(zero, light.direction);
    return light;
}

SunLight SceneReader::read_sun(const Section &section) {
    return {.to_light =
                direction_at(section.number("azimuth_deg", -360, 360).value_or(-40) * kDegree,
                             section.number("elevation_deg", -90, 90).value_or(45) * kDegree),
            .angular_radius =
                0.5 * section.number("diameter_deg", 0, 180).value_or(kSunDiameterDeg) * kDegree,
            .visible = section.flag("visible").value_or(false),
            .shadows = section.flag("shadows").value_or(true)};
}

SceneReader::GivenStrength SceneReader::read_strength(const Section &section,
                                                      const std::string &kind) {
    std::vector<const char *> units{"strength", "lux"};
    if (kind != "sun")
        units.push_back("lumen");
    if (kind == "point" || kind == "spot")
        units.push_back("candela");
    else if (kind != "ies" && kind != "sun")
        units.push_back("radiance");
    // A profile has candelas of its own
    GivenStrength given{.unit = kind == "ies" ? "candela" : "strength"};
    const char *unit = nullptr;
    for (const char *const key : units)
        if (const auto value = section.number(key, 0, 1e9)) {
            if (unit)
                section.problem(key, std::string(unit) + " and " + key + " are both given",
                                "expected one of them");
            given = {.unit = unit = key, .value = *value};
        }
    if (kind != "sun" && (given.unit == "strength" || given.unit == "lux"))
        given.at = section.vector("at");
    return given;
}

void SceneReader::give_strength(const Section &section, const GivenStrength &given,
                                const glm::dvec3 &target, Light &light) {
    const auto place = place_of(light);
    const double unit_of_lux = kPi / white_lux_; // see light.h
    double &emission = emission_of(light);
    emission = 1;
    if (given.unit == "radiance") {
        emission = given.value;
    } else if (given.unit == "candela") {
        emission = given.value * unit_of_lux;
    } else if (given.unit == "lumen") {
        emission = given.value * unit_of_lux / flux(light);
    } else {
        const glm::dvec3 at = place ? given.at.value_or(target) : kTarget;
        const glm::dvec3 to_light = place ? place->centre - at : std::get<SunLight>(light).to_light;
        const double distance = glm::length(to_light);
        const double unscaled = distance > 0 && (!place || distance > place->radius ||
                                                 !std::holds_alternative<SphereLight>(light))
                                    ? irradiance(light, at, to_light / distance)
                                    : 0;
        if (!(unscaled > 0))
            return section.problem(given.unit,
                                   "the light does not reach the point of this strength",
                                   "expected another 'at', or another unit");
        emission = given.value * (given.unit == "lux" ? unit_of_lux : kPi) / unscaled;
    }
}

} // namespace tsuya::scene

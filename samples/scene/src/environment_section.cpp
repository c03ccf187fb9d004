// The environment and the studio of a scene file.

#include <algorithm>
#include <cmath>

#include "scene_reader.h"
#include "studio_stage.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/environment_colours.h"
#include "tsuya/scene/sky.h"
#include "tsuya/scene/studio_preset.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::scene {
namespace {

constexpr const char *kOneSource = "expected one of picture, gradient and sky";

} // namespace

void SceneReader::read_studio() {
    const auto name = root_.text("studio");
    if (!name)
        return;
    note(root_, "studio",
         [&] { studio_groups_ = lit_groups(make_studio(*name, {}), !root_.has("environment")); });
    file_.studio = *name;
}

void SceneReader::read_environment() {
    const auto section = root_.section("environment");
    if (!section)
        return;
    Environment &environment = file_.environment.emplace(
        Environment{.radiance = section->number("radiance", 0, kLargest).value_or(1),
                    .group = group(*section, "environment"),
                    .visible = section->flag("visible").value_or(true)});
    read_environment_picture(*section, environment);
    if (environment.further_groups.empty())
        read_own_lamp(*section, environment.group);
    if (const auto lux = section->number("lux", 0, 1e9)) {
        if (section->has("radiance"))
            section->problem("lux", "radiance and lux are both given", "expected one of them");
        environment.radiance = 1;
        const double irradiance = level_irradiance(environment);
        if (irradiance > 0)
            environment.radiance = *lux * kPi / white_lux_ / irradiance;
        else
            section->problem("lux", "nothing shines from above the horizon",
                             "expected radiance, or a picture that is not dark there");
    }
}

void SceneReader::read_environment_picture(const Section &section, Environment &environment) {
    const auto picture = existing_file(section, "picture", false);
    if (!picture.empty()) {
        if (is_file(picture))
            note(section, "picture", [&] { environment.picture = read_image(picture); });
        environment.turn = section.number("turn_deg", -360, 360).value_or(0) * kDegree;
        if (section.flag("colour").value_or(false) && environment.picture)
            read_colours(section, environment);
    }
    if (const auto gradient = section.numbers("gradient")) {
        if (environment.picture)
            section.problem("gradient", "picture and gradient are both given", kOneSource);
        const bool valid =
            gradient->size() == 3 && std::all_of(gradient->begin(), gradient->end(),
                                                 [](double v) { return v >= 0 && v <= kLargest; });
        if (!valid)
            section.problem("gradient", "the gradient is not three radiances",
                            "expected those below, at the horizon and above");
        else
            environment.picture = gradient_picture((*gradient)[0], (*gradient)[1], (*gradient)[2]);
    }
    if (const auto sky = section.section("sky")) {
        if (environment.picture)
            section.problem("sky", "a sky and another picture are both given", kOneSource);
        read_sky(*sky, environment);
    }
}

void SceneReader::read_sky(const Section &section, Environment &environment) {
    // About the first sun, unless the section says where
    Sky sky;
    for (const Light &light : file_.lights)
        if (const auto *const sun = std::get_if<SunLight>(&light)) {
            const glm::dvec3 towards = glm::normalize(sun->to_light);
            sky.azimuth = std::atan2(towards.x, towards.z);
            sky.elevation = std::asin(towards.y);
            break;
        }
    sky.type = section.integer("type", 1, 15).value_or(sky.type);
    sky.azimuth =
        section.number("azimuth_deg", -360, 360).value_or(sky.azimuth / kDegree) * kDegree;
    sky.elevation =
        section.number("elevation_deg", -90, 90).value_or(sky.elevation / kDegree) * kDegree;
    sky.ground = section.number("ground", 0, kLargest).value_or(sky.ground);
    environment.picture = sky_picture(sky);
}

void SceneReader::read_colours(const Section &section, Environment &environment) {
    const bool shared =
        std::any_of(file_.lights.begin(), file_.lights.end(), [&](const Light &light) {
            return std::visit([&](const auto &l) { return l.group == environment.group; }, light);
        });
    if (shared)
        section.problem("group", "a light is in the group of a coloured environment",
                        "expected a group of its own, which becomes three");
    note(section, "picture", [&] {
        EnvironmentColours colours = environment_colours(*environment.picture);
        environment.picture = std::move(colours.picture);
        file_.environment_error = colours.error;
        // Its group becomes that of red; the others are called after it
        std::string &red = file_.light_groups[environment.group.value];
        const std::string name = red;
        red = name + "-red";
        for (const char *const colour : {"-green", "-blue"}) {
            environment.further_groups.push_back(
                {static_cast<std::uint32_t>(file_.light_groups.size())});
            file_.light_groups.push_back(name + colour);
        }
        file_.own_lamps.resize(file_.light_groups.size());
        for (std::size_t k = 0; k < kEnvironmentLamps; ++k)
            file_.own_lamps[k == 0 ? environment.group.value
                                   : environment.further_groups[k - 1].value] =
                kEnvironmentLampNames[k];
    });
}

} // namespace tsuya::scene

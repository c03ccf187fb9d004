#include "tsuya/sdk/scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scene_check.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/camera_check.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/light_group.h"

namespace tsuya {
namespace {

std::string size_text(const Texture &picture) {
    return std::to_string(picture.width) + " x " + std::to_string(picture.height);
}

// Collects the broken rules of a scene.
struct SceneCheck {
    const Scene &scene;
    Problems problems{};

    bool need(bool rule, std::string what, std::string where, std::string accepted) {
        return problems.need(rule, std::move(what), std::move(where), std::move(accepted));
    }

    void objects() {
        need(!scene.objects.empty(), "the scene has no object", "objects", "expected at least one");
        for (std::size_t i = 0; i < scene.objects.size(); ++i)
            check_object(scene.objects[i], "objects[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
            check_shape(scene.surfaces[i], "surfaces[" + std::to_string(i) + "]");
    }

    void check_object(const Object &object, const std::string &where) {
        const bool dresses =
            need(object.surface.value < scene.surfaces.size(),
                 "no surface " + std::to_string(object.surface.value), where + ".surface",
                 "expected an index below " + std::to_string(scene.surfaces.size()));
        const Surface *const surface = dresses ? &scene.surfaces[object.surface.value] : nullptr;
        check_cloth(object, surface, where);
        if (!surface || object.panels.empty())
            return;
        const std::size_t panels = panel_count(*surface);
        std::set<std::uint32_t> seen;
        for (std::size_t p = 0; p < object.panels.size(); ++p) {
            const PanelFabric &panel = object.panels[p];
            const std::string place = where + ".panels[" + std::to_string(p) + "]";
            check_cloth(panel, surface, place);
            if (need(panel.panel < panels, "no panel " + std::to_string(panel.panel), place,
                     "expected an index below " + std::to_string(panels)))
                need(seen.insert(panel.panel).second,
                     "panel " + std::to_string(panel.panel) + " has two fabrics", place,
                     "expected each panel once");
        }
    }

    // Of an object or a panel.
    template <class Dressed>
    void check_cloth(const Dressed &dressed, const Surface *surface, const std::string &where) {
        check_fabric_of(dressed.fabric, surface, where, ".fabric");
        if (dressed.back)
            check_fabric_of(*dressed.back, surface, where, ".back");
        for (const auto &print : {dressed.print, dressed.back_print})
            if (print)
                need(print->value < scene.prints.size(), "no print " + std::to_string(print->value),
                     where + ".print",
                     "expected an index below " + std::to_string(scene.prints.size()));
        if (dressed.opacity)
            need(dressed.opacity->value < scene.opacities.size(),
                 "no opacity " + std::to_string(dressed.opacity->value), where + ".opacity",
                 "expected an index below " + std::to_string(scene.opacities.size()));
        need(!surface || !surface->uv.empty() ||
                 !(dressed.print || dressed.back_print || dressed.opacity),
             "the surface has no UV for a picture", where, "expected the UVs of the panels");
    }

    void check_fabric_of(FabricIndex fabric, const Surface *surface, const std::string &where,
                         const char *key) {
        if (!need(fabric.value < scene.fabrics.size(), "no fabric " + std::to_string(fabric.value),
                  where + key, "expected an index below " + std::to_string(scene.fabrics.size())) ||
            !surface)
            return;
        const Fabric &cloth = scene.fabrics[fabric.value];
        need(!needs_frames(cloth) || !surface->warp.empty(),
             "fabric '" + cloth.name + "' needs yarn directions and the surface has none", where,
             "expected a surface with UV, or a grain direction to invent one");
    }

    void prints() {
        for (std::size_t i = 0; i < scene.textures.size(); ++i)
            try {
                check_texture(scene.textures[i], "textures[" + std::to_string(i) + "]");
            } catch (const Error &error) {
                problems.add(error);
            }
        for (std::size_t i = 0; i < scene.prints.size(); ++i)
            check_print(scene.prints[i], "prints[" + std::to_string(i) + "]");
        for (std::size_t i = 0; i < scene.opacities.size(); ++i) {
            const auto &[picture, placement] = scene.opacities[i];
            const std::string where = "opacities[" + std::to_string(i) + "]";
            check_placement(placement, where);
            need(picture.value < scene.textures.size() &&
                     scene.textures[picture.value].channels == 1,
                 "no texture of coverage " + std::to_string(picture.value), where,
                 "expected the index of a texture with 1 channel");
        }
    }

    void check_placement(const Placement &placement, const std::string &where) {
        const auto &[width, origin, turn, repeat] = placement;
        need(width > 0 && width <= kLargestLength,
             "the picture is " + plain_number(width) + " m wide", where + ".width",
             "expected a width above 0");
        need(is_length({origin, 0}) && std::isfinite(turn),
             "the place of the picture is not finite", where, "expected metres and radians");
    }

    void check_print(const Print &print, const std::string &where) {
        check_placement(print.placement, where);
        need(!print.layers.empty(), "the print has no layer", where, "expected a picture");
        for (std::size_t i = 0; i < print.layers.size(); ++i) {
            const PrintLayer &layer = print.layers[i];
            const std::string place = where + ".layers[" + std::to_string(i) + "]";
            if (!need(layer.picture.value < scene.textures.size() &&
                          print.layers.front().picture.value < scene.textures.size(),
                      "no texture " + std::to_string(layer.picture.value), place,
                      "expected an index below " + std::to_string(scene.textures.size())))
                continue;
            const Texture &picture = scene.textures[layer.picture.value];
            const Texture &first = scene.textures[print.layers.front().picture.value];
            need(std::abs(static_cast<double>(picture.width) * first.height -
                          static_cast<double>(first.width) * picture.height) <=
                     0.01 * first.width * picture.height,
                 "the picture is " + size_text(picture) + ", the first one " + size_text(first),
                 place, "expected pictures of one shape, because they lie alike");
            const std::size_t inks = picture.channels == 1 ? 1 : 8;
            need(layer.inks.size() == inks,
                 "the layer has " + detail::counted(layer.inks.size(), "ink"), place,
                 "expected " + std::to_string(inks) + " for this picture");
            for (const Spectrum &ink : layer.inks)
                try {
                    check_spectrum(ink, 0, 1, place + ".inks");
                } catch (const Error &error) {
                    problems.add(error);
                }
        }
    }

    // Of what is rendered.
    void fabrics() {
        for (std::size_t i = 0; i < scene.open_dyes.size(); ++i)
            need(scene.open_dyes[i].value < scene.fabrics.size(),
                 "no fabric " + std::to_string(scene.open_dyes[i].value),
                 "open_dyes[" + std::to_string(i) + "]",
                 "expected an index below " + std::to_string(scene.fabrics.size()));
        const std::vector<bool> used = fabrics_in_use(scene);
        for (std::size_t i = 0; i < used.size(); ++i)
            try {
                if (used[i])
                    check_fabric(scene.fabrics[i], "fabrics." + scene.fabrics[i].name);
            } catch (const Error &error) {
                problems.add(error);
            }
    }

    void check_shape(const Surface &surface, const std::string &where) {
        try {
            check_surface(surface, where);
        } catch (const Error &error) {
            return problems.add(error);
        }
        need(std::all_of(surface.position.begin(), surface.position.end(), is_length),
             "a vertex lies too far away", where, lengths_text());
    }

    void check_group(LightGroupIndex group, const std::string &where) {
        if (!scene.light_groups.empty()) // without any, that is the problem
            need(group.value < scene.light_groups.size(),
                 "no light group " + std::to_string(group.value), where,
                 "expected an index below " + std::to_string(scene.light_groups.size()));
    }

    void lights() {
        need(!scene.light_groups.empty(), "the scene has no light group", "light_groups",
             "expected at least one");
        for (std::size_t i = 0; i < scene.light_groups.size(); ++i)
            try {
                check_light_group(scene.light_groups[i], "light_groups[" + std::to_string(i) + "]");
            } catch (const Error &error) {
                problems.add(error);
            }
        need(!scene.lights.empty() || scene.environment, "the scene has no light", "lights",
             "expected a light or an environment");
        for (std::size_t i = 0; i < scene.lights.size(); ++i)
            std::visit(
                [&](const auto &light) {
                    const std::string where = "lights[" + std::to_string(i) + "]";
                    check_light(light, where, problems);
                    check_group(light.group, where + ".group");
                },
                scene.lights[i]);
        if (scene.environment)
            check_environment(*scene.environment);
    }

    void check_environment(const Environment &environment) {
        check_group(environment.group, "environment.group");
        for (const LightGroupIndex group : environment.further_groups)
            check_group(group, "environment.further_groups");
        need(std::isfinite(environment.turn), "the turn is not finite", "environment.turn",
             "expected radians");
        const std::size_t channels = 1 + environment.further_groups.size();
        need(channels == 1 || (channels <= kMostEnvironmentGroups && environment.picture &&
                               channels <= environment.picture->channels.size()),
             "there are " + std::to_string(channels) + " groups", "environment.further_groups",
             "expected a picture with a channel for each, and " +
                 std::to_string(kMostEnvironmentGroups) + " at most");
        if (!problems.need(is_radiance(environment.radiance),
                           "the radiance is " + plain_number(environment.radiance),
                           "environment.radiance", radiances_text()) ||
            !environment.picture)
            return;
        const Image &picture = *environment.picture;
        if (!problems.need(picture.width > 0 && picture.height > 0 && !picture.channels.empty(),
                           "the picture is empty", "environment.picture",
                           "expected at least one pixel"))
            return;
        need(std::all_of(picture.data.begin(), picture.data.end(),
                         [&](float v) { return v >= 0 && is_radiance(v * environment.radiance); }),
             "the picture has values that are not radiances", "environment.picture",
             radiances_text() + ", times environment.radiance too");
    }

    void lens(const Camera &c) {
        const Lens &lens = *c.lens;
        need(!c.orthographic_height, "an orthographic camera has no lens", "camera.lens",
             "expected a lens or orthographic_height");
        need(lens.f_number >= 0.01 && lens.f_number <= 1e6,
             "the f-number is " + plain_number(lens.f_number), "camera.lens.f_number",
             "expected 0.01 to 1e6, such as 2.8");
        need(lens.sensor_height >= 1e-6 && lens.sensor_height <= 1e6,
             "the sensor is " + plain_number(lens.sensor_height) + " m high",
             "camera.lens.sensor_height", "expected 1e-6 to 1e6 m, such as 0.036");
        need(!lens.focus_distance ||
                 (*lens.focus_distance > 0 && *lens.focus_distance <= kLargestLength),
             "the lens is focused at " + plain_number(lens.focus_distance.value_or(0)) + " m",
             "camera.lens.focus_distance", "expected a distance above 0 m before the camera");
        need(lens.blades == 0 || (lens.blades >= 3 && lens.blades <= 16),
             "the aperture has " + std::to_string(lens.blades) + " blades", "camera.lens.blades",
             "expected 0 for a round one, or 3 to 16");
    }

    void camera() {
        const Camera &c = scene.camera;
        if (!is_length(c.eye) || !is_length(c.target) || !is_length(c.up))
            need(false, "the camera lies too far away", "camera", lengths_text());
        else
            need(glm::length(glm::cross(c.target - c.eye, c.up)) > 0,
                 "the camera looks nowhere or along its up direction", "camera",
                 "expected eye and target apart, and up not parallel to the view");
        if (c.orthographic_height)
            need(*c.orthographic_height > 0 && *c.orthographic_height <= kLargestLength,
                 "the camera sees " + plain_number(*c.orthographic_height) + " m",
                 "camera.orthographic_height",
                 "expected a height above 0 and up to " + plain_number(kLargestLength) + " m");
        need(std::abs(c.shift.x) <= 10 && std::abs(c.shift.y) <= 10,
             "the picture is shifted too far", "camera.shift",
             "expected shares of its width and height from -10 to 10");
        if (c.lens)
            lens(c);
        need(c.vertical_angle > 0 && c.vertical_angle < kPi - 1e-5, "the angle of view is wrong",
             "camera.vertical_angle", "expected more than 0 and less than 180 degrees");
        need(c.width >= 1 && c.width <= 32768 && c.height >= 1 && c.height <= 32768,
             "the picture is " + std::to_string(c.width) + " x " + std::to_string(c.height),
             "camera", "expected 1 to 32768 pixels a side");
    }
};

} // namespace

std::vector<bool> fabrics_in_use(const Scene &scene) {
    std::vector<bool> used(scene.fabrics.size(), false);
    const auto use = [&](FabricIndex face, const std::optional<FabricIndex> &back) {
        for (const FabricIndex fabric : {face, back.value_or(face)})
            if (fabric.value < used.size())
                used[fabric.value] = true;
    };
    for (const Object &object : scene.objects) {
        std::set<std::uint32_t> of_its_own;
        for (const PanelFabric &panel : object.panels) {
            use(panel.fabric, panel.back);
            of_its_own.insert(panel.panel);
        }
        if (of_its_own.empty() || object.surface.value >= scene.surfaces.size() ||
            of_its_own.size() < panel_count(scene.surfaces[object.surface.value]))
            use(object.fabric, object.back);
    }
    return used;
}

void check_scene(const Scene &scene) {
    SceneCheck check{scene};
    check.objects();
    check.prints();
    check.fabrics();
    check.lights();
    check.camera();
    check.problems.throw_if_any();
}

void detail::check_camera(const Camera &camera) {
    Scene scene;
    scene.camera = camera;
    SceneCheck check{scene};
    check.camera();
    check.problems.throw_if_any();
}

} // namespace tsuya

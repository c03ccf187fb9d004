#include "tsuya/sdk/scene.h"

#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// Collects the broken rules of a scene.
struct SceneCheck {
    const Scene &scene;
    std::vector<Problem> problems{};

    void need(bool rule, std::string what, std::string where, std::string accepted) {
        if (!rule && problems.size() < kMaxProblems)
            problems.push_back({std::move(what), std::move(where), std::move(accepted)});
    }

    void objects() {
        need(!scene.objects.empty(), "the scene has no object", "objects", "expected at least one");
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            const Object &object = scene.objects[i];
            const std::string where = "objects[" + std::to_string(i) + "]";
            const bool surface = object.surface.value < scene.surfaces.size();
            const bool fabric = object.fabric.value < scene.fabrics.size();
            need(surface, "no surface " + std::to_string(object.surface.value), where + ".surface",
                 "expected an index below " + std::to_string(scene.surfaces.size()));
            need(fabric, "no fabric " + std::to_string(object.fabric.value), where + ".fabric",
                 "expected an index below " + std::to_string(scene.fabrics.size()));
            if (!surface || !fabric)
                continue;
            const Fabric &cloth = scene.fabrics[object.fabric.value];
            need(!cloth.bard || !scene.surfaces[object.surface.value].warp.empty(),
                 "fabric '" + cloth.name + "' needs yarn directions and the surface has none",
                 where, "expected a surface with UV, or a grain direction to invent one");
        }
        for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
            try {
                check_surface(scene.surfaces[i], "surfaces[" + std::to_string(i) + "]");
            } catch (const Error &error) {
                problems.push_back(error.problems()[0]);
            }
    }

    void lights() {
        need(!scene.rectangles.empty() || scene.environment, "the scene has no light", "lights",
             "expected a rectangle or an environment");
        for (std::size_t i = 0; i < scene.rectangles.size(); ++i) {
            const RectangleLight &light = scene.rectangles[i];
            const std::string where = "rectangles[" + std::to_string(i) + "]";
            need(glm::length(glm::cross(light.edge_u, light.edge_v)) > 0, "the light has no area",
                 where, "expected two edges that are not parallel");
            need(light.radiance >= 0 && std::isfinite(light.radiance), "the radiance is wrong",
                 where + ".radiance", "expected a number not below 0");
            need(light.group.value < scene.light_groups.size(), "no such light group",
                 where + ".group",
                 "expected an index below " + std::to_string(scene.light_groups.size()));
        }
        if (!scene.environment)
            return;
        need(scene.environment->radiance >= 0 && std::isfinite(scene.environment->radiance),
             "the radiance is wrong", "environment.radiance", "expected a number not below 0");
        need(scene.environment->group.value < scene.light_groups.size(), "no such light group",
             "environment.group",
             "expected an index below " + std::to_string(scene.light_groups.size()));
        if (const auto &picture = scene.environment->picture) {
            bool positive = picture->width > 0 && picture->height > 0 && !picture->channels.empty();
            for (const float v : picture->data)
                positive = positive && v >= 0 && std::isfinite(v);
            need(positive, "the picture is empty or has values that are not radiances",
                 "environment.picture", "expected finite values not below 0");
        }
    }

    void camera() {
        const Camera &c = scene.camera;
        const double side = glm::length(glm::cross(c.target - c.eye, c.up));
        need(side > 0 && std::isfinite(side), "the camera looks nowhere or along its up direction",
             "camera", "expected eye and target apart, and up not parallel to the view");
        need(c.vertical_angle > 0 && c.vertical_angle < 3.14159, "the angle of view is wrong",
             "camera.vertical_angle", "expected more than 0 and less than 180 degrees");
        need(c.width >= 1 && c.width <= 32768 && c.height >= 1 && c.height <= 32768,
             "the picture is " + std::to_string(c.width) + " x " + std::to_string(c.height),
             "camera", "expected 1 to 32768 pixels a side");
    }
};

} // namespace

void check_scene(const Scene &scene) {
    SceneCheck check{scene};
    check.objects();
    check.lights();
    check.camera();
    if (!check.problems.empty())
        throw Error(std::move(check.problems));
}

} // namespace tsuya

#include "bench/render_scenes.h"

#include <cmath>
#include <numbers>

#include "bench/bench_scene.h"
#include "tsuya/color/dye.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/scene_file.h"

namespace tsuya::bench {
namespace {

constexpr int kSkirtSize = 128; // pixels

// Warp down the skirt, weft around it.
Surface pleated_cone(unsigned around, unsigned down) {
    Surface s;
    const auto at = [&](double turn, double drop) {
        const double angle = 2 * std::numbers::pi * turn;
        const double radius = (0.15 + 0.35 * drop) * (1 + 0.12 * drop * std::cos(24 * angle));
        return glm::dvec3(radius * std::sin(angle), 0.8 - 0.75 * drop, radius * std::cos(angle));
    };
    constexpr double kStep = 1e-4;
    for (unsigned j = 0; j <= down; ++j)
        for (unsigned i = 0; i < around; ++i) {
            const double turn = double(i) / around, drop = double(j) / down;
            const glm::dvec3 weft = at(turn + kStep, drop) - at(turn - kStep, drop);
            const glm::dvec3 warp = at(turn, drop - kStep) - at(turn, drop + kStep);
            s.position.push_back(at(turn, drop));
            s.normal.emplace_back(glm::normalize(glm::cross(weft, warp)));
            s.warp.emplace_back(glm::normalize(warp));
        }
    for (unsigned j = 0; j < down; ++j)
        for (unsigned i = 0; i < around; ++i) {
            const unsigned a = j * around + i, b = j * around + (i + 1) % around;
            s.triangle.emplace_back(a, a + around, b + around);
            s.triangle.emplace_back(a, b + around, b);
        }
    return s;
}

Surface plane(double side) {
    const double h = side / 2;
    return {.position = {{-h, 0, h}, {h, 0, h}, {h, 0, -h}, {-h, 0, -h}},
            .normal = std::vector<glm::vec3>(4, {0, 1, 0}),
            .triangle = {{0, 1, 2}, {0, 2, 3}}};
}

Fabric fabric_of(const std::string &name) {
    Fabric fabric;
    if (name == "ggx")
        fabric.specular = GgxFacets{.alpha_weft = 0.05, .alpha_warp = 0.6};
    else
        fabric = read_fabric(scene::data_folder() / "fabrics/black_satin.fabric.toml");
    fabric.name = name;
    fabric.colours.dye = Spectrum::constant(0.4);
    return fabric;
}

} // namespace

Scene skirt(const std::string &fabric, int lights, int size) {
    Scene scene;
    scene.surfaces = {pleated_cone(500, 100), plane(6)};
    scene.fabrics = {fabric_of(fabric),
                     {.name = "plane", .colours = {.dye = Spectrum::constant(0.5)}}};
    scene.objects = {{"skirt", {0}, {0}}, {"plane", {1}, {1}}};
    scene.camera = {.eye = {0, 1.0, 2.6},
                    .target = {0, 0.4, 0},
                    .vertical_angle = 0.5,
                    .width = size,
                    .height = size};
    for (int i = 0; i < lights; ++i) {
        // Evenly over the arc, the first at its middle
        const double turn = -0.5 + 2.4 * (std::fmod(i * std::numbers::phi, 1.0));
        const glm::dvec3 middle(2 * std::sin(turn), 1.6 + 0.4 * std::sin(3.0 * i),
                                2 * std::cos(turn));
        const glm::dvec3 ahead = glm::normalize(glm::dvec3(0, 0.4, 0) - middle);
        const glm::dvec3 u = 0.3 * glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
        const glm::dvec3 v = glm::cross(ahead, u);
        scene.lights.push_back(RectangleLight{.corner = middle - 0.5 * (u + v),
                                              .edge_u = u,
                                              .edge_v = v,
                                              .radiance = 100.0 / lights});
    }
    return scene;
}

std::vector<RenderScene> render_scenes(const std::filesystem::path &scenes) {
    std::vector<RenderScene> list;
    for (const std::string fabric : {"ggx", "yarn"}) {
        Scene scene = skirt(fabric, 1, kSkirtSize);
        list.push_back({"direct " + fabric, scene, 0});
        scene.light_groups.emplace_back("fill");
        scene.environment = Environment{.radiance = 0.3, .group = {1}};
        list.push_back({"full " + fabric, std::move(scene), 3});
    }
    const scene::SceneFile studio = scene::read_scene_file(scenes / "studio.scene.toml");
    list.push_back({"studio", build_scene(studio).scene, studio.render.max_bounces});
    list.push_back({"dress", sample_scene(1, 100, 125), RenderSettings{}.max_bounces});
    return list;
}

std::vector<RenderScene> denoised_scenes(const std::filesystem::path &scenes) {
    std::vector<RenderScene> list;
    Scene dress = sample_scene(1, 160, 200);
    list.push_back({"crimson dress", dress, RenderSettings{}.max_bounces});
    dress.fabrics[0].colours.dye_all(parse_dye("white"));
    list.push_back({"white dress", std::move(dress), RenderSettings{}.max_bounces});
    const auto add = [&](const std::string &name, const std::filesystem::path &file) {
        scene::SceneFile read = scene::read_scene_file(file);
        read.framing.width = 160;
        read.framing.height = 200;
        list.push_back({name, build_scene(read).scene, read.render.max_bounces});
    };
    add("printed dress", scene::data_folder() / "scenes/print.scene.toml");
    add("studio dress", scenes / "studio.scene.toml");
    return list;
}

std::vector<RenderScene> speck_scenes(const std::filesystem::path &scenes) {
    constexpr int kShrink = 4;
    std::vector<RenderScene> list;
    for (const std::string colour : {"crimson", "white"}) {
        Scene dress = sample_scene(1, 200, 250);
        dress.fabrics[0].colours.dye_all(parse_dye(colour));
        list.push_back({.name = "try-on " + colour,
                        .scene = std::move(dress),
                        .max_bounces = RenderSettings{}.max_bounces,
                        .stop = scene::kTryOnQuality});
    }
    const auto add = [&](const std::string &name, const std::filesystem::path &file, int shrink) {
        scene::SceneFile read = scene::read_scene_file(file);
        read.framing.width /= shrink;
        read.framing.height /= shrink;
        list.push_back({name, build_scene(read).scene, read.render.max_bounces, read.render.stop});
    };
    for (const std::string name : {"dress", "lace", "print", "shot", "slip"})
        add(name, scene::data_folder() / "scenes" / (name + ".scene.toml"), kShrink);
    add("studio", scenes / "studio.scene.toml", 1);
    return list;
}

} // namespace tsuya::bench

#include "bench/render_scenes.h"

#include "bench/bench_scene.h"
#include "bench/skirt.h"
#include "tsuya/color/dye.h"
#include "tsuya/scene/data_folder.h"
#include "tsuya/scene/scene_file.h"

namespace tsuya::bench {
namespace {

constexpr int kSkirtSize = 128; // pixels

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
    return skirt(fabric_of(fabric), lights, size);
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

// What it saves to leave something out: processor time of tracing, or of tables, of one picture
// with and without it, as CSV. The scenes need it in neither.
//   bench_skips FABRICS [RUNS [PART_OF_FEATURE]]
// FABRICS is the folder of the sample fabrics.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "bench/skirt.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"

namespace {

using namespace tsuya;

constexpr int kSize = 128, kSamples = 32;

struct Job {
    Scene scene{};
    RenderSettings settings{};
};

struct Case {
    std::string feature, conditions;
    Job with{}, without{};
    std::string phase = "trace";
};

Job job(Scene scene, int bounces) {
    RenderSettings settings{.stop = {.samples_per_pixel = kSamples}};
    settings.max_bounces = bounces;
    return {std::move(scene), settings};
}

// Of what is idle in the scene of a job.
Case kept(const std::string &feature, const std::string &conditions, const Job &without) {
    Case c{feature, conditions, without, without};
    c.with.settings.keep = {feature};
    return c;
}

Fabric ggx() {
    return {.name = "ggx",
            .specular = GgxFacets{.alpha_weft = 0.05, .alpha_warp = 0.6},
            .colours = {.dye = Spectrum::constant(0.4)}};
}

Scene lit_skirt(int lights = 1, const Fabric &fabric = ggx()) {
    Scene scene = bench::skirt(fabric, lights, kSize);
    std::vector<glm::vec2> &uv = scene.surfaces[0].uv;
    for (const glm::dvec3 &p : scene.surfaces[0].position)
        uv.emplace_back(std::atan2(p.x, p.z), p.y);
    return scene;
}

Scene under_even_sky() {
    Scene scene = lit_skirt();
    scene.environment = Environment{.radiance = 0.3};
    return scene;
}

// The second lamp gives nothing.
Scene two_lamps(bool turned) {
    Scene scene = lit_skirt(2);
    auto &lamp = std::get<RectangleLight>(scene.lights[1]);
    if (turned)
        std::swap(lamp.edge_u, lamp.edge_v);
    else
        lamp.radiance = 0;
    return scene;
}

void add_lights_and_parts(const Fabric &yarn, std::vector<Case> &cases) {
    const std::string direct = "direct light", full = "three bounces";
    cases.push_back(kept("whole last rays", direct, job(lit_skirt(), 0)));
    cases.push_back(kept("whole last rays", full, job(lit_skirt(), 3)));
    cases.push_back(kept("whole last rays", direct + ", environment", job(under_even_sky(), 0)));
    cases.push_back(kept("dark lights", direct + ", two lamps", job(two_lamps(false), 0)));
    cases.push_back(kept("lights out of reach", direct + ", two lamps", job(two_lamps(true), 0)));
    Job even = job(under_even_sky(), 0), pictured = even;
    pictured.scene.environment->picture = Image::make(8, 4, {"Y"});
    std::fill(pictured.scene.environment->picture->data.begin(),
              pictured.scene.environment->picture->data.end(), 1.0f);
    cases.push_back({"environment sampling", direct, pictured, even});
    Job matt = job(lit_skirt(), 0), black = matt;
    matt.scene.fabrics[0].colours.specular_tint = Spectrum::constant(0);
    cases.push_back(kept("specular part", direct, matt));
    black.scene.fabrics[0].colours.dye = Spectrum::constant(0);
    cases.push_back(kept("diffuse part", direct, black));
    Job narrow = job(lit_skirt(1, yarn), 3), wide = narrow;
    wide.settings.widen_after_diffuse = true;
    cases.push_back({"wider lobes", full, wide, narrow});
}

void add_cloth(std::vector<Case> &cases) {
    const Job plain = job(lit_skirt(), 0);
    Job holes = plain, printed = plain;
    const Texture whole{.width = 1, .height = 1, .channels = 1, .data = {255}};
    for (Scene *scene : {&holes.scene, &printed.scene})
        scene->textures = {whole};
    holes.scene.opacities = {{.picture = {0}}};
    holes.scene.objects[0].opacity = OpacityIndex{0};
    cases.push_back({"holes", "direct light", holes, plain});
    printed.scene.prints = {
        {.name = "even",
         .layers = {{.picture = {0}, .inks = {plain.scene.fabrics[0].colours.dye}}}}};
    printed.scene.objects[0].print = PrintIndex{0};
    cases.push_back({"prints", "direct light", printed, plain});
}

void add_results(std::vector<Case> &cases) {
    const Job plain = job(lit_skirt(), 0);
    Job aovs = plain, parts = plain, alpha = plain;
    aovs.settings.aovs = {"coverage", "depth",   "normal",       "warp",         "weft",       "uv",
                          "albedo",   "samples", "CryptoObject", "CryptoFabric", "CryptoPanel"};
    cases.push_back({"AOVs", "direct light, all but parts of the light", aovs, plain});
    parts.settings.aovs = {"direct", "indirect", "surface", "body"};
    cases.push_back({"parts of the light", "direct light", parts, plain});
    alpha.settings.alpha = true;
    cases.push_back({"alpha", "direct light", alpha, plain});
}

void add_tables(const Fabric &yarn, const Fabric &other, std::vector<Case> &cases) {
    Job one = job(lit_skirt(1, yarn), 0), two = one;
    one.scene.fabrics.push_back(other);
    Case idle = kept("tables of idle fabrics", "one fabric", one);
    idle.phase = "tables";
    cases.push_back(idle);
    two.scene.fabrics[1] = other;
    two.scene.surfaces[1].warp.assign(4, {0, 0, -1});
    Job shared = two;
    shared.scene.fabrics[1].specular = shared.scene.fabrics[0].specular;
    cases.push_back({"tables for each fabric", "two fabrics", two, shared, "tables"});
}

double seconds_of(const Job &of, const std::string &phase) {
    for (const Phase &done : render(of.scene, of.settings).stats.phases)
        if (done.name == phase)
            return done.cpu_seconds;
    return 0;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

int main(int count, char **arguments) {
    try {
        const std::filesystem::path fabrics = count > 1 ? arguments[1] : ".";
        const int runs = count > 2 ? std::atoi(arguments[2]) : 5;
        const auto read = [&](const char *name) {
            Fabric fabric = read_fabric(fabrics / name);
            fabric.colours.dye = Spectrum::constant(0.4);
            return fabric;
        };
        const Fabric yarn = read("black_satin.fabric.toml");
        std::vector<Case> cases;
        add_lights_and_parts(yarn, cases);
        add_cloth(cases);
        add_results(cases);
        add_tables(yarn, read("black_taffeta.fabric.toml"), cases);
        std::cout << "feature,conditions,seconds_with,seconds_without,share\n";
        const std::string part = count > 3 ? arguments[3] : "";
        for (const Case &c : cases) {
            if (c.feature.find(part) == std::string::npos)
                continue;
            // In turn, so that what else the machine does meets both
            std::vector<double> with, without, share;
            for (int run = 0; run < runs; ++run) {
                with.push_back(seconds_of(c.with, c.phase));
                without.push_back(seconds_of(c.without, c.phase));
                share.push_back(1 - without.back() / with.back());
            }
            std::cout << c.feature << ",\"" << c.conditions << "\"," << median(with) << ","
                      << median(without) << "," << median(share) << std::endl;
        }
    } catch (const std::exception &error) {
        std::cerr << error.what() << "\n";
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}

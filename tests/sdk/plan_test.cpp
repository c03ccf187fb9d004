// What a plan leaves out, why, and that the picture stays the same.

#include "tsuya/sdk/plan.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

std::string why(const Scene &scene, const char *feature, const RenderSettings &settings = {}) {
    return plan(scene, settings).feature(feature).why;
}

// The lights of a plan that a render of few samples takes.
std::vector<std::size_t> lights_of(const Scene &scene) { return plan(scene, {}).lights; }

TEST(Plan, HasEachFeatureOnceWithAReason) {
    const Plan made = plan(folded_satin(8, 8), {});
    const std::vector<std::string> names = feature_names();
    ASSERT_EQ(made.features.size(), names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(made.features[i].name, names[i]);
        EXPECT_FALSE(made.features[i].why.empty()) << names[i];
        EXPECT_FALSE(made.features[i].on && made.features[i].saves) << names[i];
        EXPECT_NE(explain(made).find((made.features[i].on ? "on   " : "off  ") + names[i] + ": "),
                  std::string::npos);
    }
    EXPECT_THROW(made.feature("wings"), std::out_of_range);
}

TEST(Plan, CountsTheBytesOfWhatIsNotAskedFor) {
    const Scene scene = folded_satin(100, 50);
    // A float of each pixel in the film and in the picture
    EXPECT_EQ(plan(scene, {}).feature("alpha").saves->bytes, 2 * 4 * 100 * 50);
    EXPECT_FALSE(plan(scene, {.alpha = true}).feature("alpha").saves);
    EXPECT_EQ(text_of(*plan(scene, {}).feature("alpha").saves), "about 5 % of a sample, 40.0 kB");
    EXPECT_EQ(text_of({.of_sample = 0.123, .seconds = 0.4}), "about 12 % of a sample, about 0.4 s");
    EXPECT_EQ(text_of({}), "");
}

// Shares below 0.05 are within the noise of their measurement.
TEST(Plan, TellsNoShareWithinTheNoise) {
    Scene with_environment = folded_satin(8, 8), without = with_environment;
    without.environment.reset();
    without.lights.push_back(
        DiskLight{.name = "below", .centre = {0, -1, 0}, .direction = {0, -1, 0}});
    for (const Scene *scene : {&with_environment, &without})
        for (const int bounces : {0, 1, 2, 3, 8})
            for (const Feature &feature : plan(*scene, {.max_bounces = bounces}).features) {
                const double share = feature.saves ? feature.saves->of_sample : 0;
                EXPECT_TRUE(share == 0 || share >= 0.05) << feature.name << " " << share;
            }
    const auto of_last_rays = [&](const Scene &scene, int bounces) {
        return plan(scene, {.max_bounces = bounces}).feature("whole last rays").saves->of_sample;
    };
    EXPECT_NEAR(of_last_rays(without, 0), 0.18, 1e-9);
    EXPECT_NEAR(of_last_rays(without, 1), 0.09, 1e-9);
    EXPECT_EQ(of_last_rays(without, 3), 0);
    EXPECT_EQ(of_last_rays(with_environment, 0), 0);
    EXPECT_EQ(text_of(*plan(without, {}).feature("lights out of reach").saves), "");
}

TEST(Plan, NamesWhatIsIdle) {
    Scene scene = folded_satin(8, 8);
    scene.fabrics.push_back(satin(0.2));
    scene.fabrics.back().name = "spare";
    scene.lights.push_back(RectangleLight{.name = "out", .corner = {0, 3, 0}, .radiance = 0});
    EXPECT_EQ(why(scene, "tables of idle fabrics"), "nothing is dressed in 'spare'");
    EXPECT_EQ(why(scene, "dark lights"), "'out'");
    EXPECT_EQ(why(scene, "specular part"), "all fabrics have it but 'plain'");
    EXPECT_EQ(lights_of(scene), std::vector<std::size_t>{0});
    RenderSettings settings;
    settings.keep = {"dark lights"};
    EXPECT_EQ(plan(scene, settings).lights.size(), 2u);
    EXPECT_TRUE(plan(scene, settings).feature("dark lights").on);
    settings.keep = {"dark light"};
    EXPECT_THROW(render(scene, settings), Error);
    for (int i = 0; i < 5; ++i)
        scene.fabrics.push_back(scene.fabrics.back());
    EXPECT_EQ(why(scene, "tables of idle fabrics"),
              "nothing is dressed in 'spare', 'spare', 'spare' and 3 more");
}

// An object of which every panel has a fabric of its own does not need another.
TEST(Plan, AFabricBelowAllPanelsIsIdle) {
    Scene scene = folded_satin(8, 8);
    Surface &sheet = scene.surfaces[0];
    sheet.panel.assign(sheet.triangle.size(), 0);
    sheet.panel.back() = 1;
    scene.fabrics.push_back(lambert(0.3));
    scene.objects[0].panels = {{.panel = 0, .fabric = {2}}};
    EXPECT_EQ(fabrics_in_use(scene), (std::vector<bool>{true, true, true}));
    scene.objects[0].panels.push_back({.panel = 1, .fabric = {1}});
    EXPECT_EQ(fabrics_in_use(scene), (std::vector<bool>{false, true, true}));
    RenderSettings settings = quick(4);
    const SpectralImage lean = render(scene, settings).image;
    settings.keep = {"tables of idle fabrics"};
    EXPECT_EQ(render(scene, settings).image.transport, lean.transport);
}

TEST(Plan, TellsOfTablesThatAreShared) {
    Scene scene = folded_satin(8, 8);
    EXPECT_TRUE(plan(scene, {}).feature("tables for each fabric").on);
    scene.fabrics[1] = satin(0.9);
    scene.fabrics[1].name = "white";
    const Feature shared = plan(scene, {}).feature("tables for each fabric");
    EXPECT_FALSE(shared.on);
    EXPECT_EQ(shared.why, "another has the specular part of 'white'");
    PreparedScene prepared;
    EXPECT_EQ(render(scene, quick(1), {}, &prepared).stats.prepared.tables.made, 1u);
    find_specular<CarriedViews>(scene.fabrics[1])->f0 = 0.2;
    EXPECT_TRUE(plan(scene, {}).feature("tables for each fabric").on);
    EXPECT_EQ(render(scene, quick(1), {}, &prepared).stats.prepared.tables.made, 1u);
}

// Beside the sheet, facing away from it or past it.
std::vector<Light> lights_that_miss() {
    const PointLight spot{.name = "spot",
                          .position = {0, 9, 12},
                          .direction = {0, 1, 0},
                          .full_angle = 0.3,
                          .cone_angle = 0.8};
    return {RectangleLight{.name = "turned",
                           .corner = {-1, 1, 8},
                           .edge_u = {1, 0, 0},
                           .edge_v = {0, 1, 0},
                           .radiance = 50},
            DiskLight{.name = "below", .centre = {0, -1, 0}, .direction = {0, -1, 0}}, spot};
}

TEST(Plan, LightsThatShinePastAllSurfacesAreLeftOut) {
    for (const Light &light : lights_that_miss()) {
        Scene scene = folded_satin(24, 24);
        scene.lights.push_back(light);
        EXPECT_EQ(lights_of(scene), std::vector<std::size_t>{0}) << name_of(light);
        EXPECT_EQ(why(scene, "lights out of reach"),
                  "'" + name_of(light) + "' shines past all surfaces");
        RenderSettings settings = quick(8);
        settings.max_bounces = 2;
        settings.keep = {"lights out of reach"};
        const RenderResult full = render(scene, settings);
        settings.keep.clear();
        const RenderResult lean = render(scene, settings);
        // After bounces one of the lights is chosen by other numbers; what the camera sees directly
        // is the same to the bit
        settings.max_bounces = 0;
        const std::vector<float> direct = render(scene, settings).image.transport;
        settings.keep = {"lights out of reach"};
        EXPECT_EQ(render(scene, settings).image.transport, direct) << name_of(light);
        const auto sum = [](const RenderResult &of) {
            return std::accumulate(of.image.transport.begin(), of.image.transport.end(), 0.0);
        };
        EXPECT_NEAR(sum(lean) / sum(full), 1, 0.02) << name_of(light);
        // Not where it is seen, or hides others
        if (auto *disk = std::get_if<DiskLight>(&scene.lights.back())) {
            disk->behaviour.blocks = true;
            EXPECT_EQ(lights_of(scene).size(), 2u);
        }
    }
}

// Lights that reach a part of the scene count, however narrow.
TEST(Plan, LightsThatReachASurfaceAreKept) {
    Scene scene = folded_satin(24, 24);
    scene.lights = {
        RectangleLight{.corner = {-1, 1.99, 0.2}, .edge_u = {0, 0.001, 1}, .edge_v = {2, 0, 0}},
        DiskLight{.centre = {0, 1, 0}, .direction = {0, 0, -1}, .radius = 0.01},
        PointLight{.position = {0, 9, 12}, .direction = {0, -8, -12}, .cone_angle = 0.01},
        SphereLight{.centre = {0, 50, 0}, .radius = 0.01}, SunLight{.to_light = {0, -1, 0}}};
    EXPECT_EQ(lights_of(scene).size(), 5u);
}

TEST(Plan, LightsThatAreLostInRoundingAreLeftOut) {
    Scene scene = folded_satin(24, 24);
    scene.environment.reset();
    scene.lights = {SphereLight{.centre = {0, 4, 5}, .radius = 0.2, .radiance = 20},
                    SphereLight{.name = "dim", .centre = {1, 4, 5}, .radius = 0.2, .radiance = 20}};
    // The dim one gives at most so much more in the nearest corner than the other in the farthest
    double factor = 1;
    while (lights_of(scene).size() == 2 && factor > 1e-12)
        emission_of(scene.lights[1]) = 20 * (factor /= 2);
    EXPECT_LT(factor, 3e-8);
    EXPECT_GT(factor, 3e-10);
    const std::string told = why(scene, "lights out of reach");
    EXPECT_NE(told.find("'dim' gives at most "), std::string::npos) << told;
    RenderSettings settings = quick(16);
    settings.max_bounces = 0;
    const std::vector<float> lean = render(scene, settings).image.transport;
    settings.keep = {"lights out of reach"};
    const std::vector<float> full = render(scene, settings).image.transport;
    const float brightest = *std::max_element(full.begin(), full.end());
    for (std::size_t i = 0; i < full.size(); ++i)
        ASSERT_NEAR(lean[i], full[i], 1e-7f * brightest);
    // Another lamp may be given to another group: it counts there
    scene.light_groups = {"key", "other"};
    std::get<SphereLight>(scene.lights[1]).group = {1};
    EXPECT_EQ(lights_of(scene).size(), 2u);
}

} // namespace

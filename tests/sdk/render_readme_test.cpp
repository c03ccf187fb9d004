// The example of sdk/README.md, compiled and run.

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

// [doc:sdk_example]
#include "tsuya/sdk/render.h"

// A surface in a satin that was fitted to a measured table, under one softbox.
tsuya::RenderResult portrait(const tsuya::Surface &dress, const tsuya::ReflectanceTable &table) {
    tsuya::Fabric satin{.name = "black satin"};
    satin.specular = tsuya::CarriedViews{.bard = tsuya::Bard::fit(table, "table.csv")};
    satin.colours.dye = {{420, 560, 620}, {0.05, 0.06, 0.55}}; // reflectance, 0..1

    tsuya::Scene scene;
    scene.surfaces = {dress};
    scene.fabrics = {satin};
    scene.objects = {{.name = "dress", .surface = {0}, .fabric = {0}}};
    scene.lights = {
        tsuya::RectangleLight{.corner = {-1, 1, 3}, .edge_u = {-1, 0, -1}, .edge_v = {0, 1, 0}}};
    scene.camera = {.eye = {0, 1, 4}, .target = {0, 1, 0}, .width = 40, .height = 50};
    return tsuya::render(scene, {.stop = {.samples_per_pixel = 16}, .channels = 8});
}
// [/doc:sdk_example]

TEST(Readme, ExampleRenders) {
    using namespace tsuya;
    const Scene scene = test::folded_satin(8, 8);
    ReflectanceTable table;
    const Bard bard = test::satin_bard();
    for (const BardView &v : bard.views())
        table.rows.push_back({0, 0, v.theta, v.phi, v.brdf_per_sr, 0});
    const RenderResult result = portrait(scene.surfaces[0], table);
    float largest = 0;
    for (const float t : result.image.transport)
        largest = std::max(largest, t);
    EXPECT_GT(largest, 0.01f);
    EXPECT_EQ(result.stats.not_finite, 0u);
}

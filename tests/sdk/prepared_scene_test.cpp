// Renders that take over what others have built.

#include "tsuya/sdk/prepared_scene.h"

#include <atomic>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A sheet above a floor, and a still sphere in it; the sheet is the first surface.
Scene stage() {
    Scene scene = folded_satin(24, 24);
    Surface ball = sphere(12, 16);
    for (glm::dvec3 &p : ball.position)
        p = 0.2 * p + glm::dvec3(0.1, 0.3, 0);
    scene.surfaces.push_back(std::move(ball));
    scene.fabrics.push_back(lambert(0.5));
    scene.objects.push_back({"ball",
                             {static_cast<std::uint32_t>(scene.surfaces.size() - 1)},
                             {static_cast<std::uint32_t>(scene.fabrics.size() - 1)}});
    return scene;
}

void wave(Scene &scene, int frame) {
    for (glm::dvec3 &p : scene.surfaces[0].position)
        p.y += 0.01 * frame * std::sin(5 * p.x);
}

// Renders by what is prepared and anew, to the same bits.
void expect_same(PreparedScene &prepared, const Scene &scene, const RenderSettings &settings,
                 const char *what) {
    const RenderResult kept = render(scene, settings, {}, &prepared);
    const RenderResult fresh = render(scene, settings);
    EXPECT_EQ(kept.image.transport, fresh.image.transport) << what;
    EXPECT_EQ(kept.stats.rays, fresh.stats.rays) << what;
}

TEST(PreparedScene, BuildsWhatMovesAlone) {
    PreparedScene prepared;
    const std::size_t objects = stage().objects.size();
    for (int frame = 0; frame < 4; ++frame) {
        Scene scene = stage(); // of its own: the one before is gone
        wave(scene, frame);
        expect_same(prepared, scene, quick(4), "frame");
        EXPECT_EQ(prepared.use().objects_built, objects + static_cast<std::size_t>(frame));
    }
    EXPECT_EQ(prepared.use().objects_kept, 3 * (objects - 1));
    EXPECT_EQ(prepared.use().tables.made, 1u);
}

TEST(PreparedScene, BuildsNothingForOtherCamerasDyesLightsAndSettings) {
    PreparedScene prepared;
    Scene scene = stage();
    expect_same(prepared, scene, quick(4), "first");
    const PreparedUse first = prepared.use();
    scene.camera.eye += glm::dvec3(0.5, 0.2, 0);
    expect_same(prepared, scene, quick(4), "camera");
    scene.fabrics[0].colours.dye = Spectrum::constant(0.7);
    expect_same(prepared, scene, quick(4), "dye");
    RectangleLight &light = std::get<RectangleLight>(scene.lights[0]);
    light.radiance *= 2;
    light.corner += glm::dvec3(0.1, 0, 0);
    expect_same(prepared, scene, quick(4), "light");
    RenderSettings settings = quick(4);
    settings.seed = 7;
    settings.crop = {4, 4, 20, 16};
    expect_same(prepared, scene, settings, "settings");
    settings.channels = 32;
    expect_same(prepared, scene, settings, "channels");
    EXPECT_EQ(prepared.use().objects_built, first.objects_built);
    EXPECT_EQ(prepared.use().tables.made, first.tables.made);
}

TEST(PreparedScene, FollowsEveryOtherChange) {
    PreparedScene prepared;
    Scene scene = stage();
    expect_same(prepared, scene, quick(4), "first");
    scene.objects.pop_back();
    expect_same(prepared, scene, quick(4), "an object less");
    scene.objects.push_back(stage().objects.back());
    scene.objects.push_back(stage().objects.back()); // in one place with another
    expect_same(prepared, scene, quick(4), "two more");
    std::swap(scene.objects.front(), scene.objects.back());
    expect_same(prepared, scene, quick(4), "another order");
    std::swap(scene.surfaces[0].triangle[0].x, scene.surfaces[0].triangle[0].y);
    expect_same(prepared, scene, quick(4), "a triangle turned");
    scene.surfaces[0].triangle.pop_back();
    expect_same(prepared, scene, quick(4), "a triangle less");
    for (Surface &surface : scene.surfaces)
        for (glm::dvec3 &p : surface.position)
            p += glm::dvec3(100, 0, 0);
    scene.camera.eye.x += 100;
    scene.camera.target.x += 100;
    expect_same(prepared, scene, quick(4), "another place");
    find_specular<CarriedViews>(scene.fabrics[0])->f0 = 0.2;
    expect_same(prepared, scene, quick(4), "another cloth");
}

TEST(PreparedScene, SurvivesAnInterruptedRender) {
    PreparedScene prepared;
    Scene scene = stage();
    const std::atomic<bool> stop{true};
    EXPECT_TRUE(render(scene, quick(4), {.stop = &stop}, &prepared).stats.interrupted);
    expect_same(prepared, scene, quick(4), "stopped before the first");
    wave(scene, 1);
    EXPECT_TRUE(render(scene, quick(4), {.stop = &stop}, &prepared).stats.interrupted);
    expect_same(prepared, scene, quick(4), "stopped");
}

} // namespace

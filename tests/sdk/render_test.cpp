// Scenes whose radiance is known in closed form, and what a render promises: the same picture for
// any number of threads, tile order, stop and resume, and with every skip off.

#include <filesystem>
#include <numbers>
#include <thread>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A white body in a white environment cannot be seen, though its shading normals are far from its
// triangles' normals.
TEST(Furnace, WhiteLambertIsInvisible) {
    RenderSettings settings = quick(64);
    settings.max_bounces = 1000;
    const RenderResult result = render(furnace(lambert(1.0)), settings);
    EXPECT_LT(largest_difference(result.image, 0, 1.0), 1e-3);
    EXPECT_EQ(result.stats.not_finite, 0u);
}

TEST(Furnace, GreyLambertIsSeen) { // negative control
    RenderSettings settings = quick(64);
    settings.max_bounces = 1000;
    EXPECT_GT(largest_difference(render(furnace(lambert(0.98)), settings).image, 0, 1.0), 1e-2);
}

// A folded white sheet, with light going back and forth between its folds.
TEST(Furnace, WhiteFoldsAreInvisible) {
    Scene scene = folded_satin(20, 20);
    scene.fabrics[0] = lambert(1);
    scene.fabrics[1] = lambert(1);
    scene.lights.clear();
    scene.light_groups = {"key"};
    scene.environment = Environment{.radiance = 1};
    RenderSettings settings = quick(16);
    settings.max_bounces = 4000;
    EXPECT_LT(largest_difference(render(scene, settings).image, 0, 1.0), 1e-3);
}

// Irradiance of a parallel rectangle, over its radiance: four times the form factor of a quarter
// seen from its corner, [Howell] configuration B-4.
double irradiance_below_rectangle(double a, double b, double height) {
    const double x = a / height, y = b / height;
    const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
    return 4 * 0.5 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

TEST(ClosedForm, PlaneBelowRectangle) {
    constexpr double kAlbedo = 0.6, kRadiance = 5, kHalf = 0.7, kHeight = 1.5;
    Scene scene;
    scene.surfaces = {floor_square(20)};
    scene.fabrics = {lambert(kAlbedo)};
    scene.objects = {{"floor", {0}, {0}}};
    scene.lights = {RectangleLight{.corner = {-kHalf, kHeight, -kHalf},
                                   .edge_u = {2 * kHalf, 0, 0},
                                   .edge_v = {0, 0, 2 * kHalf},
                                   .radiance = kRadiance}};
    scene.camera = {.eye = {0, 1.2, 0},
                    .target = {0, 0, 0},
                    .up = {0, 0, -1},
                    .vertical_angle = 0.002,
                    .width = 4,
                    .height = 4};
    // edge_u x edge_v looks down
    const double expected =
        kAlbedo / std::numbers::pi * kRadiance * irradiance_below_rectangle(kHalf, kHalf, kHeight);
    const RenderResult result = render(scene, quick(4096));
    EXPECT_LT(largest_difference(result.image, 0, expected), 2e-3 * expected);

    // The picture sees only the light's other side: dark
    RectangleLight &light = std::get<RectangleLight>(scene.lights[0]);
    std::swap(light.edge_u, light.edge_v);
    EXPECT_EQ(largest_difference(render(scene, quick(4)).image, 0, 0.0), 0.0);
}

// A light cut into many gives what the light gives: to the camera's vertex and after bounces, where
// few of the many are chosen.
TEST(ClosedForm, ManyLightsAreOne) {
    Scene scene = folded_satin(16, 16);
    scene.environment.reset();
    const RectangleLight whole = std::get<RectangleLight>(scene.lights[0]);
    const auto totals = [&](const RenderSettings &settings) {
        const SpectralImage image = render(scene, settings).image;
        std::vector<double> rows(16);
        for (int y = 0; y < 16; ++y)
            for (int x = 0; x < 16; ++x)
                rows[std::size_t(y)] += image.pixel(0, x, y)[3];
        return rows;
    };
    for (const int bounces : {0, 4}) {
        RenderSettings settings = quick(1024);
        settings.max_bounces = bounces;
        scene.lights = {whole};
        const std::vector<double> one = totals(settings);
        constexpr int kParts = 5;
        scene.lights.clear();
        for (int i = 0; i < kParts * kParts; ++i) {
            RectangleLight part = whole;
            part.edge_u /= kParts;
            part.edge_v /= kParts;
            part.corner += double(i % kParts) * part.edge_u + double(i / kParts) * part.edge_v;
            scene.lights.push_back(part);
        }
        const std::vector<double> many = totals(settings);
        for (std::size_t y = 0; y < one.size(); ++y)
            EXPECT_NEAR(many[y], one[y], 0.01 * one[y] + 0.01) << bounces << " bounces, row " << y;
    }
}

// An environment picture that is even must give what an even environment gives, though it is
// sampled.
TEST(ClosedForm, EvenPictureIsEvenEnvironment) {
    Scene scene;
    scene.surfaces = {floor_square(2)};
    scene.fabrics = {satin(0.3)};
    scene.objects = {{"cloth", {0}, {0}}};
    scene.camera = {.eye = {0, 1.2, 0.9},
                    .target = {0, 0, 0},
                    .vertical_angle = 0.002,
                    .width = 4,
                    .height = 4};
    scene.environment = Environment{.radiance = 0.7};
    const float even = *render(scene, quick(4096)).image.pixel(0, 1, 1);
    Image picture = Image::make(8, 4, {"Y"});
    std::fill(picture.data.begin(), picture.data.end(), 0.5f);
    scene.environment = Environment{.radiance = 1.4, .picture = picture};
    const float sampled = *render(scene, quick(4096)).image.pixel(0, 1, 1);
    EXPECT_NEAR(sampled, even, 0.01 * even);
    EXPECT_LT(even, 0.7); // no more than the environment gives
}

TEST(Promises, SamePictureForAnyNumberOfThreads) {
    const Scene scene = folded_satin(70, 50);
    RenderSettings settings = quick(12);
    settings.threads = 1;
    const SpectralImage one = render(scene, settings).image;
    for (const int threads : {2, 7}) {
        settings.threads = threads;
        EXPECT_EQ(render(scene, settings).image.transport, one.transport) << threads << " threads";
    }
    settings.seed = 1;
    EXPECT_NE(render(scene, settings).image.transport, one.transport);
}

TEST(Promises, CropIsThatPartOfThePicture) {
    const Scene scene = folded_satin(70, 50);
    RenderSettings settings = quick(4);
    const SpectralImage whole = render(scene, settings).image;
    settings.crop = {10, 5, 60, 45};
    const SpectralImage part = render(scene, settings).image;
    for (int y = 0; y < 50; ++y)
        for (int x = 0; x < 70; ++x) {
            const bool inside = x >= 10 && x < 60 && y >= 5 && y < 45;
            EXPECT_EQ(part.pixel(0, x, y)[3], inside ? whole.pixel(0, x, y)[3] : 0.0f);
        }
}

TEST(Promises, StopAndResumeChangeNothing) {
    const Scene scene = folded_satin(70, 50);
    RenderSettings settings = quick(24);
    const SpectralImage whole = render(scene, settings).image;

    settings.checkpoint = std::filesystem::path(testing::TempDir()) / "tsuya-render.checkpoint";
    std::filesystem::remove(settings.checkpoint);
    settings.threads = 2;
    std::atomic<bool> stop{false};
    Progress progress{.report = [&](std::string_view stage,
                                    double done) { stop = stage == "render" && done > 0.4; },
                      .stop = &stop};
    const RenderResult cut = render(scene, settings, progress);
    ASSERT_TRUE(cut.stats.interrupted);
    EXPECT_NE(cut.image.transport, whole.transport);
    ASSERT_TRUE(std::filesystem::exists(settings.checkpoint));

    settings.resume = true;
    settings.threads = 1;
    EXPECT_EQ(render(scene, settings).image.transport, whole.transport);
    std::filesystem::remove(settings.checkpoint);
}

TEST(Promises, CheckpointOfAnotherSceneIsRefused) {
    RenderSettings settings = quick(24);
    settings.checkpoint = std::filesystem::path(testing::TempDir()) / "tsuya-other.checkpoint";
    std::atomic<bool> stop{false};
    render(folded_satin(70, 50), settings,
           {.report = [&](std::string_view stage,
                          double done) { stop = stage == "render" && done > 0.4; },
            .stop = &stop});
    settings.resume = true;
    Scene brighter = folded_satin(70, 50), other_yarn = brighter, tinted = brighter;
    emission_of(brighter.lights[0]) = 9;
    other_yarn.fabrics[0].specular = YarnLobes{};
    tinted.fabrics[0].colours.weft_tint = Spectrum::constant(0.5);
    for (const Scene &other : {brighter, other_yarn, tinted})
        try {
            render(other, settings);
            FAIL() << "accepted";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].where, settings.checkpoint.string());
        }
    std::filesystem::remove(settings.checkpoint);
}

TEST(Promises, SkippingChangesNothing) {
    Scene scene = folded_satin(40, 40);
    scene.fabrics.push_back(satin(0.2)); // dresses nothing
    scene.fabrics[1].colours.specular_tint = Spectrum::constant(0);
    scene.lights.push_back(RectangleLight{.corner = {0, 3, 0}, .radiance = 0});
    RenderSettings settings = quick(8);
    const SpectralImage lean = render(scene, settings).image;
    for (const char *idle : {"tables of idle fabrics", "dark lights", "whole last rays"})
        EXPECT_FALSE(plan(scene, settings).feature(idle).on) << idle;
    settings.skip = false;
    for (const char *idle : {"tables of idle fabrics", "dark lights", "whole last rays"})
        EXPECT_TRUE(plan(scene, settings).feature(idle).on) << idle;
    EXPECT_EQ(render(scene, settings).image.transport, lean.transport);
}

// Rays after the last vertex look for lights alone: beside an environment, beside a rectangle, and
// behind holes.
TEST(Promises, ShortLastRaysChangeNothing) {
    Scene with_environment = folded_satin(40, 40), without = with_environment;
    without.environment.reset();
    for (const int bounces : {0, 2}) {
        std::vector<double> rays;
        for (const Scene *scene : {&with_environment, &without}) {
            RenderSettings settings = quick(8);
            settings.max_bounces = bounces;
            const RenderResult lean = render(*scene, settings);
            settings.skip = false;
            const RenderResult full = render(*scene, settings);
            EXPECT_EQ(lean.image.transport, full.image.transport) << bounces;
            rays.push_back(double(lean.stats.rays.all()) / double(full.stats.rays.all()));
        }
        EXPECT_EQ(rays[0], 1) << bounces;
        EXPECT_LT(rays[1], bounces == 0 ? 0.75 : 0.98) << bounces;
    }
}

TEST(Promises, RaysAreCountedByTheirKind) {
    Scene scene = folded_satin(16, 16);
    RenderSettings settings = quick(8);
    settings.max_bounces = 0;
    const RayCounts direct = render(scene, settings).stats.rays;
    EXPECT_EQ(direct.camera, 16u * 16 * 8);
    EXPECT_LE(direct.shadow, direct.camera); // of one lamp
    EXPECT_GT(direct.shadow, direct.camera / 4);
    EXPECT_LE(direct.bounce, direct.camera); // to the environment
    EXPECT_GT(direct.bounce, direct.camera / 2);
    settings.max_bounces = 3;
    const RayCounts more = render(scene, settings).stats.rays;
    EXPECT_EQ(more.camera, direct.camera);
    EXPECT_GT(more.bounce, direct.bounce);
}

// Two lights in two groups add up to both in one group.
TEST(Promises, GroupsAddUp) {
    Scene scene = folded_satin(32, 32);
    const SpectralImage apart = render(scene, quick(16)).image;
    EXPECT_GT(apart.pixel(0, 16, 16)[2], 0.1f);
    EXPECT_GT(apart.pixel(1, 16, 16)[2], 0.01f);
    scene.environment->group = {0};
    const SpectralImage together = render(scene, quick(16)).image;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            EXPECT_NEAR(apart.pixel(0, x, y)[2] + apart.pixel(1, x, y)[2],
                        together.pixel(0, x, y)[2], 1e-5f);
}

} // namespace

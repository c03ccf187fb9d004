// Scenes at the edge of what they may be: very many parts, and lights at odd places.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

constexpr int kAcross = 100; // as many squares a side

double albedo_of(int i) { return 0.1 + 0.8 * ((i * 7919) % 10000) / 10000; }

// Ten thousand squares in a plane, each an object with a fabric of its own, in an even environment.
Scene patchwork() {
    Scene scene;
    for (int i = 0; i < kAcross * kAcross; ++i) {
        const double x = i % kAcross - 0.5 * kAcross, y = i / kAcross - 0.5 * kAcross;
        Surface square;
        square.position = {{x, y, 0}, {x + 1, y, 0}, {x + 1, y + 1, 0}, {x, y + 1, 0}};
        square.normal.assign(4, {0, 0, 1});
        square.triangle = {{0, 1, 2}, {0, 2, 3}};
        const auto index = static_cast<std::uint32_t>(i);
        scene.surfaces.push_back(std::move(square));
        scene.fabrics.push_back(lambert(albedo_of(i)));
        scene.fabrics.back().name += std::to_string(i);
        scene.objects.push_back({"square" + std::to_string(i), {index}, {index}});
    }
    scene.environment = Environment{.radiance = 1};
    scene.camera = {.eye = {0, 0, 10}, .target = {0, 0, 0}, .width = kAcross, .height = kAcross};
    scene.camera.orthographic_height = kAcross;
    return scene;
}

TEST(Stress, TenThousandObjectsInTenThousandFabrics) {
    Scene scene = patchwork();
    RenderSettings settings = quick(4);
    settings.aovs = {"CryptoFabric"};
    const SpectralImage image = render(scene, settings).image;
    for (int y = 0; y < kAcross; ++y) // row 0 is the highest
        for (int x = 0; x < kAcross; ++x)
            ASSERT_NEAR(*image.pixel(0, x, y), albedo_of((kAcross - 1 - y) * kAcross + x), 1e-5);
}

// The ball of a radius of 1 about the origin, and a camera that looks at it.
Scene ball_lit_by(const Light &light) {
    Scene scene = furnace(lambert(0.5));
    scene.environment.reset();
    scene.lights = {light};
    return scene;
}

double brightest(const Scene &scene) {
    RenderSettings settings = quick(16);
    const RenderResult result = render(scene, settings);
    EXPECT_EQ(result.stats.not_finite, 0u);
    return largest_difference(result.image, 0, 0.0);
}

// Within a closed body no light leaves it; its inside is lit where the camera is inside too.
TEST(Stress, ALightInsideABodyStaysThere) {
    const std::vector<Light> lights = {
        PointLight{.position = {0.1, 0.2, 0}, .intensity = 5},
        SphereLight{.centre = {0, 0, 0.2}, .radius = 0.1, .radiance = 50},
        DiskLight{.centre = {0, 0, 0}, .radius = 0.2, .radiance = 50},
        RectangleLight{.corner = {-0.2, -0.2, 0},
                       .edge_u = {0.4, 0, 0},
                       .edge_v = {0, 0.4, 0},
                       .radiance = 50}};
    for (const Light &light : lights) {
        Scene scene = ball_lit_by(light);
        EXPECT_EQ(brightest(scene), 0) << light.index();
        scene.camera.eye = {0, 0, -0.3};
        scene.camera.target = {0, 0, 1};
        EXPECT_GT(brightest(scene), 0.01) << light.index();
    }
}

TEST(Stress, LightsBehindTheCameraShine) {
    const Light before = PointLight{.position = {0, 0.5, 3}, .intensity = 9};
    const Light behind = PointLight{.position = {0, 0.5, 9}, .intensity = 16 * 9};
    const Light at_the_eye = PointLight{.position = {0, 0.5, 4}, .intensity = 9};
    const double value = brightest(ball_lit_by(before));
    EXPECT_GT(value, 0.1);
    // At the points of the ball that are nearest; a pixel has the mean of what is about them
    const auto nearest = [](double height, double z) { return std::hypot(height, z) - 1; };
    const double expected = 16 * std::pow(nearest(0.5, 3) / nearest(0.5, 9), 2);
    EXPECT_NEAR(brightest(ball_lit_by(behind)) / value, expected, 0.03);
    EXPECT_GT(brightest(ball_lit_by(at_the_eye)), 0.1);
    // A lamp that would be seen, were the camera turned
    Scene seen = ball_lit_by(SphereLight{
        .centre = {0, 0.5, 9}, .radius = 0.5, .radiance = 1000, .behaviour = {.visible = true}});
    EXPECT_LT(brightest(seen), 100);
    seen.camera.target = {0, 0.5, 9};
    EXPECT_NEAR(brightest(seen), 1000, 1e-2);
}

// Powers of two of one light give pictures that are the same to the bit, times that power.
TEST(Stress, LightsOfAnyStrengthGiveOnePicture) {
    const auto picture = [](double strength) {
        Scene scene = ball_lit_by(SphereLight{.centre = {1, 3, 3}, .radius = 0.2});
        emission_of(scene.lights[0]) = strength;
        std::vector<float> values = render(scene, quick(16)).image.transport;
        for (float &value : values)
            value = static_cast<float>(double(value) / strength);
        return values;
    };
    const std::vector<float> one = picture(1);
    for (const int power : {-100, -60, 30}) // 1e-30, 1e-18, 1e9
        EXPECT_EQ(picture(std::ldexp(1.0, power)), one) << power;
    EXPECT_THROW(picture(1e30), Error);
}

} // namespace

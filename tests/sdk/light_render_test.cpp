// What lights of every kind give to a picture: closed forms, what is seen and blocked, and the
// bounds of their values.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

constexpr double kAlbedo = 0.6;

// A floor, and a camera that sees one point of it.
Scene floor_seen_at(const glm::dvec3 &point, const std::vector<Light> &lights) {
    Scene scene;
    scene.surfaces = {floor_square(40)};
    scene.fabrics = {lambert(kAlbedo)};
    scene.objects = {{"floor", {0}, {0}}};
    scene.lights = lights;
    scene.camera = {.eye = point + glm::dvec3(0, 0.2, 0),
                    .target = point,
                    .up = {0, 0, -1},
                    .vertical_angle = 1e-4,
                    .width = 4,
                    .height = 4};
    return scene;
}

double mean(const SpectralImage &image, std::size_t group = 0) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += double(image.pixel(group, x, y)[0]) / image.width / image.height;
    return sum;
}

// Irradiance that a floor has at a point, by a render.
double rendered(const glm::dvec3 &point, const std::vector<Light> &lights, int samples = 1024) {
    RenderSettings settings = quick(samples);
    settings.max_bounces = 0;
    return mean(render(floor_seen_at(point, lights), settings).image) * std::numbers::pi / kAlbedo;
}

struct Lit {
    const char *name;
    Light light;
    glm::dvec3 point;
    double irradiance; // of the floor, in closed form
};

std::vector<Lit> lit_floors() {
    constexpr double kHeight = 1.5;
    const glm::dvec3 above(0, kHeight, 0), aside(0.8, 0, 0);
    const double distance2 = kHeight * kHeight + 0.64, cosine = kHeight / std::sqrt(distance2);
    const double angle = std::acos(cosine), full = 0.3, cone = 0.7;
    const double x = (cosine - std::cos(cone)) / (std::cos(full) - std::cos(cone));
    const DiskLight disk{.centre = above, .direction = {0, -1, 0}, .radius = 0.5, .radiance = 4};
    const SphereLight sphere{.centre = above, .radius = 0.4, .radiance = 4};
    const PointLight point{.position = above, .intensity = 4};
    PointLight spot = point, narrow = point;
    spot.full_angle = full;
    spot.cone_angle = cone;
    narrow.full_angle = narrow.cone_angle = angle * 0.9;
    const double pi = std::numbers::pi;
    // [Howell] configuration B-12 for the disk beside the point
    const double h = kHeight / 0.8, r = 0.5 / 0.8, z = 1 + h * h + r * r;
    const double beside = 0.5 * (1 - (1 + h * h - r * r) / std::sqrt(z * z - 4 * r * r));
    return {
        {"disk", disk, {0, 0, 0}, pi * 4 * 0.25 / (0.25 + kHeight * kHeight)},
        {"disk beside", disk, aside, pi * 4 * beside},
        {"sphere", sphere, {0, 0, 0}, pi * 4 * 0.16 / (kHeight * kHeight)},
        {"sphere beside", sphere, aside, pi * 4 * 0.16 / distance2 * cosine},
        {"point", point, aside, 4 / distance2 * cosine},
        {"spot", spot, {0, 0, 0}, 4 / (kHeight * kHeight)},
        {"spot at its edge", spot, aside, 4 / distance2 * cosine * x * x * (3 - 2 * x)},
        {"beside a spot", narrow, aside, 0},
        {"sun", SunLight{.to_light = {1, 1, 0}, .irradiance = 3}, {0, 0, 0}, 3 / std::sqrt(2.0)},
        {"parallel sun",
         SunLight{.to_light = {1, 1, 0}, .angular_radius = 0, .irradiance = 3},
         {0, 0, 0},
         3 / std::sqrt(2.0)},
        {"wide sun",
         SunLight{.to_light = {1, 1, 0}, .angular_radius = 0.7, .irradiance = 3},
         {0, 0, 0},
         3 / std::sqrt(2.0)},
    };
}

TEST(LightClosedForm, FloorUnderEveryKind) {
    for (const Lit &lit : lit_floors()) {
        EXPECT_NEAR(rendered(lit.point, {lit.light}), lit.irradiance, 4e-3 * lit.irradiance + 1e-6)
            << lit.name;
        EXPECT_NEAR(irradiance(lit.light, lit.point, {0, 1, 0}), lit.irradiance,
                    1e-4 * lit.irradiance)
            << lit.name;
    }
}

// Many lights of all kinds in one scene, of which two are chosen a sample, give their sum.
TEST(LightClosedForm, TenThousandLights) {
    std::vector<Light> lights;
    double expected = 0;
    for (int i = 0; i < 10000; ++i) {
        const double turn = 2.4 * i, distance = 0.3 + 0.0004 * i;
        const glm::dvec3 at(distance * std::cos(turn), 1 + 0.7 * std::sin(0.37 * i),
                            distance * std::sin(turn));
        const double strength = 1e-3 * (1 + i % 7);
        if (i % 4 == 0)
            lights.emplace_back(
                SphereLight{.centre = at, .radius = 0.02, .radiance = strength * 800});
        else if (i % 4 == 1)
            lights.emplace_back(PointLight{.position = at, .intensity = strength});
        else if (i % 4 == 2)
            lights.emplace_back(PointLight{
                .position = at, .intensity = 10 * strength, .full_angle = 0.2, .cone_angle = 0.5});
        else
            lights.emplace_back(DiskLight{
                .centre = at, .direction = -at, .radius = 0.03, .radiance = strength * 400});
        expected += std::max(0.0, irradiance(lights.back(), {0, 0, 0}, {0, 1, 0}));
    }
    EXPECT_NEAR(rendered({0, 0, 0}, lights, 2048), expected, 0.02 * expected);
    lights.erase(lights.begin(), lights.begin() + 500); // negative control: they would be missed
    EXPECT_LT(rendered({0, 0, 0}, lights, 2048), 0.975 * expected);
}

// A ray of the camera towards a light.
Scene looking_at(const Light &light, bool from_behind) {
    Scene scene = floor_seen_at({0, 0, 0}, {light});
    scene.light_groups = {"key", "sky"};
    scene.environment = Environment{.radiance = 0.25, .group = {1}};
    scene.camera.eye = {0, 1, from_behind ? 4 : -4};
    scene.camera.target = {0, 1, 0};
    scene.camera.up = {0, 1, 0};
    return scene;
}

// The light of the sky behind it, and its own.
glm::dvec2 seen(const Light &light, bool from_behind = false) {
    const SpectralImage image = render(looking_at(light, from_behind), quick(16)).image;
    return {mean(image, 1), mean(image, 0)};
}

TEST(LightBehaviour, TheCameraSeesWhatIsVisible) {
    const auto disk = [](LightBehaviour behaviour) {
        return DiskLight{.centre = {0, 1, 0}, .radius = 0.5, .radiance = 7, .behaviour = behaviour};
    };
    EXPECT_EQ(seen(disk({})), glm::dvec2(0.25, 0));
    EXPECT_EQ(seen(disk({.blocks = true})), glm::dvec2(0.25, 0));
    EXPECT_EQ(seen(disk({.visible = true})), glm::dvec2(0, 7));
    EXPECT_EQ(seen(disk({.visible = true}), true), glm::dvec2(0.25, 0));
    EXPECT_EQ(seen(disk({.visible = true, .blocks = true}), true), glm::dvec2(0, 0));
    EXPECT_EQ(seen(SphereLight{.centre = {0, 1, 0}, .radiance = 3, .behaviour = {.visible = true}}),
              glm::dvec2(0, 3));
    EXPECT_EQ(seen(RectangleLight{.corner = {-1, 0.5, 0},
                                  .edge_u = {0, 1, 0},
                                  .edge_v = {2, 0, 0},
                                  .radiance = 5,
                                  .behaviour = {.visible = true}}),
              glm::dvec2(0, 5));
    const double wide = std::sin(0.1);
    EXPECT_NEAR(
        seen(SunLight{
                 .to_light = {0, 0, 1}, .angular_radius = 0.1, .irradiance = 2, .visible = true})
            .y,
        2 / (std::numbers::pi * wide * wide), 1e-3);
    EXPECT_EQ(seen(SunLight{.to_light = {0, 0, 1}, .angular_radius = 0.1}).y, 0);
}

TEST(LightBehaviour, WhatBlocksThrowsShadows) {
    const Light lamp = PointLight{.position = {0, 2, 0}, .intensity = 4};
    DiskLight dark{.centre = {0, 1, 0}, .direction = {0, 1, 0}, .radius = 0.5, .radiance = 0};
    EXPECT_NEAR(rendered({0, 0, 0}, {lamp, dark}, 16), 1, 1e-5);
    dark.behaviour.blocks = true;
    EXPECT_EQ(rendered({0, 0, 0}, {lamp, dark}, 16), 0);
    EXPECT_GT(rendered({1.2, 0, 0}, {lamp, dark}, 16), 0.1);
    // Its own light still leaves it
    DiskLight bright{.centre = {0, 1, 0}, .direction = {0, -1, 0}, .radius = 0.5, .radiance = 1};
    bright.behaviour.blocks = true;
    const double alone = std::numbers::pi * 0.25 / 1.25;
    EXPECT_NEAR(rendered({0, 0, 0}, {lamp, bright}), alone, 4e-3 * alone);

    // And of the sky it takes what it covers
    Scene scene = floor_seen_at({0, 0, 0}, {dark});
    scene.environment = Environment{.radiance = 1};
    RenderSettings settings = quick(4096);
    settings.max_bounces = 0;
    const double open = 1 - 0.25 / 1.25;
    EXPECT_NEAR(mean(render(scene, settings).image), kAlbedo * open, 4e-3 * kAlbedo * open);
    settings.max_bounces = 3; // with rays that are not the last
    EXPECT_NEAR(mean(render(scene, settings).image), kAlbedo * open, 8e-3 * kAlbedo * open);
}

TEST(LightBehaviour, LightWithoutShadowsGoesThroughThings) {
    for (const bool shadows : {true, false})
        for (const Light &light :
             {Light(SphereLight{
                  .centre = {0, 3, 0}, .radius = 0.1, .behaviour = {.shadows = shadows}}),
              Light(DiskLight{
                  .centre = {0, 3, 0}, .direction = {0, -1, 0}, .behaviour = {.shadows = shadows}}),
              Light(PointLight{.position = {0, 3, 0}, .shadows = shadows}),
              Light(SunLight{.angular_radius = 0.1, .shadows = shadows})}) {
            Scene scene = floor_seen_at({0, 0, 0}, {light});
            Surface lid = floor_square(1);
            for (glm::dvec3 &p : lid.position)
                p.y = 2;
            scene.surfaces.push_back(lid);
            scene.objects.push_back({"lid", {1}, {0}});
            RenderSettings settings = quick(1024);
            settings.max_bounces = 0;
            const double expected =
                shadows ? 0 : kAlbedo / std::numbers::pi * irradiance(light, {0, 0, 0}, {0, 1, 0});
            EXPECT_NEAR(mean(render(scene, settings).image), expected, 4e-3 * expected)
                << light.index();
        }
}

// As Promises.SkippingChangesNothing, with lights of every kind.
TEST(LightPromises, SkippingChangesNothing) {
    Scene scene = folded_satin(32, 32);
    scene.lights.insert(
        scene.lights.end(),
        {DiskLight{.radius = 0.3, .behaviour = {.visible = true, .blocks = true}},
         SphereLight{.radiance = 9, .behaviour = {.blocks = true}},
         PointLight{.position = {1, 2, 1}, .full_angle = 0.1, .cone_angle = 0.9},
         SunLight{.to_light = {1, 1, 1}, .angular_radius = 0.1},
         DiskLight{
             .centre = {0, 0.5, 1}, .radius = 0.1, .radiance = 0, .behaviour = {.visible = true}},
         PointLight{.intensity = 0}, SunLight{.irradiance = 0}});
    for (const bool environment : {true, false}) {
        if (!environment)
            scene.environment.reset();
        RenderSettings settings = quick(8);
        settings.max_bounces = 3;
        const SpectralImage lean = render(scene, settings).image;
        EXPECT_EQ(plan(scene, settings).lights.size(), 6u);
        settings.skip = false;
        EXPECT_EQ(plan(scene, settings).lights.size(), 8u);
        const SpectralImage full = render(scene, settings).image;
        double apart = 0, sum = 0; // the choice of one of more lights differs
        for (std::size_t i = 0; i < lean.transport.size(); ++i) {
            apart += double(lean.transport[i] - full.transport[i]);
            sum += double(full.transport[i]);
        }
        EXPECT_NEAR(apart / sum, 0, 0.02);
    }
}

TEST(LightErrors, AreAtTheirPlace) {
    const auto place = [](const Light &light) {
        return place_of_fault(floor_seen_at({0, 0, 0}, {light}));
    };
    for (const double wrong : {-1.0, 1e30, double(NAN)}) {
        EXPECT_EQ(place(DiskLight{.radiance = wrong}), "lights[0].radiance");
        EXPECT_EQ(place(SphereLight{.radiance = wrong}), "lights[0].radiance");
        EXPECT_EQ(place(PointLight{.intensity = wrong}), "lights[0].intensity");
        EXPECT_EQ(place(SunLight{.irradiance = wrong}), "lights[0].irradiance");
        EXPECT_EQ(place(DiskLight{.centre = {wrong * 1e20, 0, 0}}), "lights[0]");
        EXPECT_EQ(place(PointLight{.cone_angle = wrong}), "lights[0].cone_angle");
        EXPECT_EQ(place(SunLight{.angular_radius = wrong}), "lights[0].angular_radius");
    }
    EXPECT_EQ(place(DiskLight{.radius = 0}), "lights[0].radius");
    EXPECT_EQ(place(DiskLight{.radius = -1}), "lights[0].radius");
    EXPECT_EQ(place(SphereLight{.radius = 1e-9}), "lights[0].radius");
    EXPECT_EQ(place(DiskLight{.direction = {0, 0, 0}}), "lights[0].direction");
    EXPECT_EQ(place(PointLight{.direction = {0, 0, 0}}), "lights[0].direction");
    EXPECT_EQ(place(SunLight{.to_light = {0, 0, 0}}), "lights[0].to_light");
    EXPECT_EQ(place(PointLight{.full_angle = 1, .cone_angle = 0.5}), "lights[0].full_angle");
    EXPECT_EQ(place(SphereLight{.group = {3}}), "lights[0].group");
    EXPECT_EQ(place(PointLight{}), "accepted");
}

// Weak and strong lights keep their proportions, chosen one of many.
TEST(LightErrors, VeryWeakLightsAreNoDarkOnes) {
    std::vector<Light> weak, strong;
    for (int i = 0; i < 12; ++i) {
        SphereLight light{
            .centre = {0.3 * i - 1.5, 2, 0}, .radius = 0.05, .radiance = 1e-30 * (i + 1)};
        weak.emplace_back(light);
        light.radiance *= 1e42;
        strong.emplace_back(light);
    }
    double expected = 0;
    for (const Light &light : weak)
        expected += irradiance(light, {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(rendered({0, 0, 0}, weak) / expected, 1, 5e-3);
    EXPECT_THROW(check_scene(floor_seen_at({0, 0, 0}, strong)), Error);
    for (Light &light : strong)
        emission_of(light) /= 100;
    EXPECT_NEAR(rendered({0, 0, 0}, strong) / expected / 1e40, 1, 5e-3);
}

} // namespace

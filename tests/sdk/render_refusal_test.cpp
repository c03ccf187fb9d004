// Scenes and settings that a render refuses, with what it says of them.

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

TEST(Errors, SceneAndSettings) {
    const auto where = [](const Scene &scene, const RenderSettings &settings) {
        try {
            render(scene, settings);
        } catch (const Error &error) {
            return error.problems()[0].where;
        }
        return std::string("accepted");
    };
    const Scene good = folded_satin(8, 8);
    Scene scene = good;
    scene.objects[1].fabric = {9};
    EXPECT_EQ(where(scene, quick(1)), "objects[1].fabric");
    scene = good;
    scene.surfaces[0].warp.clear();
    EXPECT_EQ(where(scene, quick(1)), "objects[0]");
    // Also of a fabric without views; not of one that may be turned
    scene.fabrics[0].specular = GgxFacets{.alpha_weft = 0.05, .alpha_warp = 0.6};
    EXPECT_EQ(where(scene, quick(1)), "objects[0]");
    scene.fabrics[0].specular = YarnLobes{};
    EXPECT_EQ(where(scene, quick(1)), "objects[0]");
    scene.fabrics[0].specular = GgxFacets{.alpha_weft = 0.2, .alpha_warp = 0.2};
    EXPECT_EQ(where(scene, quick(1)), "accepted");
    scene = good;
    scene.surfaces[1].triangle[0].x = 77;
    EXPECT_EQ(where(scene, quick(1)), "surfaces[1]");
    scene = good;
    std::get<RectangleLight>(scene.lights[0]).edge_v =
        std::get<RectangleLight>(scene.lights[0]).edge_u;
    EXPECT_EQ(where(scene, quick(1)), "lights[0]");
    scene = good;
    scene.camera.up = scene.camera.target - scene.camera.eye;
    EXPECT_EQ(where(scene, quick(1)), "camera");
    scene = good;
    find_specular<CarriedViews>(scene.fabrics[0])->f0 = 1.5;
    EXPECT_EQ(where(scene, quick(1)), "fabrics.satin.f0");
    RenderSettings settings = quick(0);
    EXPECT_EQ(where(good, settings), "spp");
    settings = quick(1);
    settings.channels = 7;
    EXPECT_EQ(where(good, settings), "channels");
    settings = quick(1);
    settings.crop = {0, 0, 9, 8};
    EXPECT_EQ(where(good, settings), "crop");
    settings = quick(1);
    settings.aovs = {"depht"};
    EXPECT_EQ(where(good, settings), "aov");
}

// The problems of a render that must be refused.
std::vector<Problem> problems_of(const Scene &scene, const RenderSettings &settings) {
    try {
        render(scene, settings);
    } catch (const Error &error) {
        return error.problems();
    }
    ADD_FAILURE() << "accepted";
    return {{"", "", ""}};
}

TEST(Errors, MemoryIsAskedForBeforeItIsTaken) {
    Scene scene = folded_satin(32768, 32768);
    scene.light_groups.resize(256, "group"); // 35 TB
    const Problem p = problems_of(scene, quick(1))[0];
    EXPECT_EQ(p.where, "camera");
    EXPECT_NE(p.what.find("32768 x 32768 pixels of 8 channels in 256 light groups need 17.6 TB"),
              std::string::npos)
        << p.what;
    EXPECT_NE(p.accepted.find("expected at most "), std::string::npos) << p.accepted;
}

TEST(Errors, RadiancesThatOverflow) {
    const auto only_problem = [](const Scene &scene) {
        const std::vector<Problem> problems = problems_of(scene, quick(1));
        EXPECT_EQ(problems.size(), 1u);
        EXPECT_NE(problems[0].accepted.find("1e+12"), std::string::npos) << problems[0].accepted;
        return problems[0].where;
    };
    const Scene good = folded_satin(8, 8);
    for (const double radiance : {1e300, 2e12, -1.0, std::nan(""), HUGE_VAL}) {
        Scene scene = good;
        emission_of(scene.lights[0]) = radiance;
        EXPECT_EQ(only_problem(scene), "lights[0].radiance");
        scene = good;
        scene.environment->radiance = radiance;
        EXPECT_EQ(only_problem(scene), "environment.radiance");
    }
    Scene scene = good;
    scene.environment->picture = Image::make(4, 2, {"Y"});
    scene.environment->picture->data[3] = 1e10f;
    scene.environment->radiance = 1000;
    EXPECT_EQ(only_problem(scene), "environment.picture");
}

TEST(Errors, TheLargestRadianceGivesAFinitePicture) {
    Scene scene = folded_satin(16, 16);
    emission_of(scene.lights[0]) = scene.environment->radiance = kLargestRadiance;
    const RenderResult result = render(scene, quick(64));
    EXPECT_EQ(result.stats.not_finite, 0u);
    EXPECT_TRUE(std::isfinite(result.stats.relative_error));
    for (const float t : result.image.transport)
        ASSERT_TRUE(std::isfinite(t));
}

TEST(Errors, OneProblemForOneCause) {
    const auto only_where = [](const Scene &scene) {
        const std::vector<Problem> problems = problems_of(scene, quick(1));
        EXPECT_EQ(problems.size(), 1u);
        return problems[0].where;
    };
    const Scene good = folded_satin(8, 8);
    Scene scene = good;
    scene.light_groups.clear();
    EXPECT_EQ(only_where(scene), "light_groups");
    scene = good;
    std::get<RectangleLight>(scene.lights[0]).corner.x = std::nan("");
    EXPECT_EQ(only_where(scene), "lights[0]");
    scene.lights[0] = RectangleLight{.edge_u = {1e-9, 0, 0}, .edge_v = {0, 1e-9, 0}};
    EXPECT_EQ(only_where(scene), "lights[0]");
    scene = good;
    scene.camera.eye.z = 1e30;
    EXPECT_EQ(only_where(scene), "camera");
    scene = good;
    scene.surfaces[0].position[5].y = 1e10;
    EXPECT_EQ(only_where(scene), "surfaces[0]");
    const auto with = [&](auto &&change) {
        scene = good;
        change(scene.camera);
        return only_where(scene);
    };
    EXPECT_EQ(with([](Camera &c) { c.shift.y = -11; }), "camera.shift");
    EXPECT_EQ(with([](Camera &c) { c.shift.x = std::nan(""); }), "camera.shift");
    for (const double height : {0.0, -1.0, std::nan(""), 1e10})
        EXPECT_EQ(with([&](Camera &c) { c.orthographic_height = height; }),
                  "camera.orthographic_height");
    EXPECT_EQ(with([](Camera &c) {
                  c.orthographic_height = 1;
                  c.lens = Lens{};
              }),
              "camera.lens");
    EXPECT_EQ(with([](Camera &c) { c.lens = Lens{.f_number = 0}; }), "camera.lens.f_number");
    EXPECT_EQ(with([](Camera &c) { c.lens = Lens{.sensor_height = -1}; }),
              "camera.lens.sensor_height");
    EXPECT_EQ(with([](Camera &c) { c.lens = Lens{.focus_distance = -2.0}; }),
              "camera.lens.focus_distance");
    for (const int blades : {-1, 1, 2, 17})
        EXPECT_EQ(with([&](Camera &c) { c.lens = Lens{.blades = blades}; }), "camera.lens.blades");
}

TEST(Errors, StopRulesAreFinite) {
    const Scene good = folded_satin(8, 8);
    for (const double wrong : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
        RenderSettings settings = quick(1);
        settings.stop.relative_error = wrong;
        EXPECT_EQ(problems_of(good, settings)[0].where, "error");
        settings = quick(1);
        settings.stop.seconds = wrong;
        EXPECT_EQ(problems_of(good, settings)[0].where, "time");
        settings = quick(1);
        settings.checkpoint_seconds = wrong;
        if (wrong != 0) {
            EXPECT_EQ(problems_of(good, settings)[0].where, "checkpoint_seconds");
        }
    }
}

// Triangles so small that their normals vanish in float numbers.
TEST(Errors, SamplesThatAreNotFiniteEndTheRender) {
    Scene scene = folded_satin(8, 8);
    for (Surface &surface : scene.surfaces)
        for (glm::dvec3 &p : surface.position)
            p *= 1e-12;
    scene.camera.eye *= 1e-12;
    scene.camera.target *= 1e-12;
    const Problem p = problems_of(scene, quick(16))[0];
    EXPECT_EQ(p.where, "scene");
    EXPECT_NE(p.what.find("not finite"), std::string::npos) << p.what;
}

} // namespace

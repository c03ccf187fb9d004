// A camera that moves: between its keys, and in scenes.

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/scene/camera_path.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"

namespace tsuya::scene {
namespace {

// At uneven times, on no line.
const std::vector<CameraKey> kKeys{{0, {0, 1, 4}, {0, 1, 0}, 0.5},
                                   {0.2, {1, 1.5, 3}, {0, 1.1, 0}, 0.4},
                                   {0.7, {2, 1, 1}, {0.3, 1, 0}, 0.4},
                                   {1, {2, 2, 0}, {0.3, 1.2, -1}, 0.6}};

glm::dvec3 eye(double at) { return camera_between(kKeys, {}, at).eye; }

TEST(CameraPath, GoesThroughItsKeysSmoothly) {
    for (const CameraKey &key : kKeys) {
        const Camera camera = camera_between(kKeys, {.width = 7}, key.at);
        EXPECT_NEAR(glm::length(camera.eye - key.eye), 0, 1e-12) << key.at;
        EXPECT_NEAR(glm::length(camera.target - key.target), 0, 1e-12) << key.at;
        EXPECT_NEAR(camera.vertical_angle, key.vertical_angle, 1e-12) << key.at;
        EXPECT_EQ(camera.width, 7);
    }
    constexpr double kStep = 1e-6;
    for (const double at : {0.2, 0.7}) {
        const glm::dvec3 before = (eye(at) - eye(at - kStep)) / kStep;
        const glm::dvec3 after = (eye(at + kStep) - eye(at)) / kStep;
        EXPECT_GT(glm::length(before), 1);
        EXPECT_NEAR(glm::length(after - before), 0, 1e-3) << at;
    }
    EXPECT_NEAR(glm::length(eye(kStep) - eye(0)) / kStep, 0, 1e-3) << "at rest";
    EXPECT_NEAR(glm::length(eye(1) - eye(1 - kStep)) / kStep, 0, 1e-3);
}

// A parabola has its own slope at the inner keys, so that the cubic between them is the parabola.
TEST(CameraPath, FollowsAParabola) {
    std::vector<CameraKey> keys;
    const auto height = [](double at) { return 2 - 3 * at + 5 * at * at; };
    for (const double at : {0.0, 0.1, 0.5, 0.6, 1.0})
        keys.push_back({.at = at, .eye = {0, height(at), 3}});
    for (const double at : {0.15, 0.3, 0.45, 0.55})
        EXPECT_NEAR(camera_between(keys, {}, at).eye.y, height(at), 1e-12) << at;
}

TEST(CameraPath, OfTwoKeysIsTheSmoothStep) {
    const std::vector<CameraKey> keys{{.at = 0, .eye = {0, 0, 0}}, {.at = 1, .eye = {1, 0, 0}}};
    EXPECT_NEAR(camera_between(keys, {}, 0.25).eye.x, 0.15625, 1e-12); // 3 t^2 - 2 t^3
    EXPECT_EQ(share_of_frame(0, 1), 0);
    EXPECT_EQ(share_of_frame(3, 4), 1);
}

std::string moving_scene(const std::string &more = "", const std::string &of_mesh = "") {
    return "[camera]\nwidth = 8\nheight = 10\nf_number = 2\nfocus = [0, 0.3, 0]\n"
           "path = [{ at = 0, eye = [0, 1, 3], target = [0, 0.3, 0] }, { at = 1, eye = [3, 1, 0], "
           "target = [0, 0.3, 0], vertical_angle_deg = 40 }]\n" +
           more + "[environment]\n[fabrics.silk]\n[garments.cloth]\nmesh = \"cloth.obj\"\n" +
           "fabric = \"silk\"\n" + of_mesh + "[render]\nsamples_per_pixel = 2\n";
}

BuiltScene build(const Scratch &scratch, const std::string &text, std::size_t frames) {
    scratch.write("cloth.obj", cloth_obj());
    return build_scene(read_scene_file(scratch.write("a.scene.toml", text)), {}, frames);
}

TEST(CameraPath, MovesASceneThatStandsStill) {
    const Scratch scratch;
    BuiltScene built = build(scratch, moving_scene(), 3);
    ASSERT_EQ(built.frames.count(), 3u);
    EXPECT_EQ(built.scene.camera.eye, glm::dvec3(0, 1, 3));
    EXPECT_NEAR(built.scene.camera.vertical_angle, 24 * kDegree, 1e-12);
    PreparedScene prepared;
    render(built.scene, {.stop = {.samples_per_pixel = 1}}, {}, &prepared);
    const std::vector<glm::dvec3> before = built.scene.surfaces[0].position;
    built.frames.show(1, built.scene);
    EXPECT_NEAR(glm::length(built.scene.camera.eye - glm::dvec3(1.5, 1, 1.5)), 0, 1e-12);
    EXPECT_NEAR(*built.scene.camera.lens->focus_distance,
                distance_along_view(built.scene.camera, {0, 0.3, 0}), 1e-12);
    // What stands still is not built again
    const PreparedUse use = prepared.use();
    render(built.scene, {.stop = {.samples_per_pixel = 1}}, {}, &prepared);
    EXPECT_EQ(prepared.use().since(use).objects_built, 0u);
    EXPECT_EQ(built.scene.surfaces[0].position, before);
    built.frames.show(2, built.scene);
    EXPECT_NEAR(built.scene.camera.vertical_angle, 40 * kDegree, 1e-12);
}

TEST(CameraPath, IsRefusedWhereAFrameSeesNothing) {
    const Scratch scratch;
    // Between the keys the camera is above its target
    std::string text = moving_scene();
    text.replace(text.find("[3, 1, 0]"), 9, "[0, 1, -3]");
    try {
        build(scratch, text, 3);
        ADD_FAILURE() << "no error was thrown";
    } catch (const Error &error) {
        EXPECT_NE(error.problems()[0].where.find("camera.path, frame 1"), std::string::npos)
            << error.what();
    }
    EXPECT_THROW(build(scratch, moving_scene("", "tolerance_px = 0.5\n"), 2), Error);
}

TEST(Meshes, AreTurnedBeforeTheyAreMoved) {
    const Scratch scratch;
    const Scene still = build(scratch, moving_scene(), 1).scene;
    const Scene turned =
        build(scratch, moving_scene("", "turn_deg = 90\ntranslate = [1, 2, 3]\n"), 1).scene;
    const Surface &a = still.surfaces[0], &b = turned.surfaces[0];
    ASSERT_EQ(a.position.size(), b.position.size());
    for (std::size_t v = 0; v < a.position.size(); ++v) {
        const glm::dvec3 p = a.position[v];
        EXPECT_NEAR(glm::length(b.position[v] - glm::dvec3(p.z + 1, p.y + 2, 3 - p.x)), 0, 1e-12);
        EXPECT_NEAR(glm::length(b.warp[v] - glm::vec3(a.warp[v].z, a.warp[v].y, -a.warp[v].x)), 0,
                    1e-6);
    }
}

// A mesh that is turned sees camera and lights as one that stands so in its file.
TEST(Meshes, ArePixelsWideAlsoWhereTheyAreTurned) {
    const Scratch scratch;
    const auto triangles = [&](const std::string &camera, const std::string &mesh) {
        return build(scratch,
                     "[camera]\nwidth = 400\nheight = 500\n" + camera +
                         "[environment]\n[fabrics.silk]\n[bodies.cloth]\nmesh = \"bent.obj\"\n"
                         "fabric = \"silk\"\ntolerance_px = 0.05\n" +
                         mesh,
                     1)
            .scene.surfaces[0]
            .triangle.size();
    };
    // A bent strip, whose limit surface is curved
    scratch.write("bent.obj", "v -1 0 0\nv -1 1 0\nv 0 0 1\nv 0 1 1\nv 1 0 0\nv 1 1 0\n"
                              "f 1 3 4 2\nf 3 5 6 4\n");
    const std::size_t straight = triangles("eye = [0, 0.5, 6]\ntarget = [0, 0.5, 0]\n", "");
    EXPECT_GT(straight, 8u);
    EXPECT_EQ(straight, triangles("eye = [7, 0.5, 0]\ntarget = [1, 0.5, 0]\n",
                                  "turn_deg = 90\ntranslate = [1, 0, 0]\n"));
}

} // namespace
} // namespace tsuya::scene

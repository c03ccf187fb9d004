// Scenes that move.

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/render.h"

namespace tsuya::scene {
namespace {

/// The piece of cloth with its upper edge moved forwards.
std::string leaning(double z) {
    std::string text = cloth_obj();
    for (const std::string corner : {"0.2 0.6 0\n", "-0.2 0.6 0\n"}) {
        const std::size_t at = text.find("v " + corner) + 2 + corner.size() - 2;
        text.replace(at, 1, std::to_string(z));
    }
    return text;
}

SceneFile moving_scene(const Scratch &scratch, const std::string &keys) {
    for (int k = 0; k < 4; ++k)
        scratch.write(k == 0 ? "cloth.obj" : "c" + std::to_string(k) + ".obj", leaning(0.1 * k));
    std::string text = small_scene("[garments.still]\nmesh = \"c3.obj\"\nfabric = \"silk\"\n"
                                   "translate = [2, 0, 0]\n");
    text.insert(text.find("fabric = \"silk\""), keys + "\n");
    return read_scene_file(scratch.write("m.scene.toml", text));
}

TEST(SceneFrames, AreTheMeshesOfTheirFiles) {
    const Scratch scratch;
    const SceneFile file = moving_scene(
        scratch, "frames = [\"c1.obj\", \"c2.obj\"]\ntranslate = [0.5, 0, 0]\nlevel = 2");
    BuiltScene built = build_scene(file, {}, 3);
    EXPECT_EQ(built.frames.count(), 3u);
    const Surface still = built.scene.surfaces[1];
    const Camera camera = built.scene.camera;
    for (const int frame : {1, 2, 0}) {
        built.frames.show(static_cast<std::size_t>(frame), built.scene);
        const std::string name = frame == 0 ? "cloth.obj" : "c" + std::to_string(frame) + ".obj";
        const SceneFile alone = moving_scene(scratch, "translate = [0.5, 0, 0]\nlevel = 2");
        SceneFile one = alone;
        one.garments[0].mesh = scratch / name;
        const Surface expected = build_scene(one).scene.surfaces[0];
        const Surface &shown = built.scene.surfaces[0];
        ASSERT_EQ(shown.position.size(), expected.position.size());
        for (std::size_t v = 0; v < shown.position.size(); ++v) {
            EXPECT_LT(glm::distance(shown.position[v], expected.position[v]), 1e-12) << frame;
            EXPECT_LT(glm::distance(shown.warp[v], expected.warp[v]), 1e-5f) << frame;
            EXPECT_EQ(shown.uv[v], expected.uv[v]);
        }
    }
    EXPECT_EQ(built.scene.surfaces[1].position, still.position);
    EXPECT_EQ(built.scene.camera.eye, camera.eye);
}

TEST(SceneFrames, TheCameraSeesAllThatAreWanted) {
    const Scratch scratch;
    scratch.write("far.obj", leaning(30));
    const SceneFile file = moving_scene(scratch, "frames = [\"c1.obj\", \"far.obj\"]");
    const auto distance = [](const BuiltScene &built) {
        return glm::distance(built.scene.camera.eye, built.scene.camera.target);
    };
    const double near = distance(build_scene(file, {}, 2));
    EXPECT_GT(distance(build_scene(file, {}, 3)), 2 * near);
    EXPECT_EQ(build_scene(file).frames.count(), 1u);
}

TEST(SceneFrames, WithATolerance) {
    const Scratch scratch;
    BuiltScene built =
        build_scene(moving_scene(scratch, "frames = [\"c1.obj\"]\ntolerance_px = 0.5"), {}, 2);
    const std::size_t triangles = built.scene.surfaces[0].triangle.size();
    built.frames.show(1, built.scene);
    EXPECT_EQ(built.scene.surfaces[0].triangle.size(), triangles);
    double front = 0;
    for (const glm::dvec3 &p : built.scene.surfaces[0].position)
        front = std::max(front, p.z);
    EXPECT_NEAR(front, 0.1, 1e-9);
}

TEST(SceneFrames, TooFewAreAnError) {
    const Scratch scratch;
    const auto problem = [&](const std::string &keys, std::size_t frames) {
        try {
            build_scene(moving_scene(scratch, keys), {}, frames);
        } catch (const Error &error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(problem("frames = [\"c1.obj\"]", 3).find("cloth has 2 frames"), std::string::npos);
    EXPECT_NE(problem("", 2).find("nothing moves"), std::string::npos);
    EXPECT_NE(problem("morph_targets = true", 2).find("cloth has 1 frame"), std::string::npos);
    EXPECT_NE(problem("frames = [\"none.obj\"]", 1).find("there is no file"), std::string::npos);
    scratch.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    EXPECT_NE(problem("frames = [\"other.obj\"]", 2).find("other.obj"), std::string::npos);
    EXPECT_EQ(problem("frames = [\"c1.obj\"]", 2), "");
}

} // namespace
} // namespace tsuya::scene

// Holes that glTF materials state, laid on the cloth.

#include <cmath>

#include <gtest/gtest.h>

#include "garment/gltf_samples.h"
#include "samples/scratch.h"
#include "tsuya/color/image_file.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/tryon.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

/// The alpha of the picture, from its left and its top.
double alpha_at(double across, double down) { return 0.2 + 0.5 * across + 0.25 * down; }

void write_picture(const std::filesystem::path &file) {
    Image image = Image::make(64, 32, {"R", "G", "B", "A"});
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            image.pixel(x, y)[3] =
                static_cast<float>(alpha_at((x + 0.5) / image.width, (y + 0.5) / image.height));
    write_png(file, image);
}

/// A square of 1 m with glTF UVs (x, 1 - y). \param transform of the texture
std::string square(const std::string &mode, const std::string &transform,
                   const std::string &more = "") {
    std::string json = garment::test::square_json(
        "", R"(,"alphaMode":")" + mode +
                R"(","pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{)"
                R"("KHR_texture_transform":{)" +
                transform + "}}}}" + more);
    json.insert(1, R"("textures":[{"source":0}],"images":[{"uri":"my%20lace.png"}],)");
    return garment::test::glb(json, garment::test::square_buffer());
}

/// Of a scene with the square as a garment or a body.
BuiltScene build(const Scratch &scratch, const std::string &mesh, const std::string &keys = "",
                 const std::string &kind = "garments") {
    write_picture(scratch / "my lace.png");
    scratch.write("square.glb", mesh);
    return build_scene(read_scene_file(scratch.write(
        "s.scene.toml", "[fabrics.silk]\ndye = \"crimson\"\n[environment]\n[" + kind +
                            ".square]\nmesh = \"square.glb\"\nfabric = \"silk\"\nlevel = 2\n" +
                            keys)));
}

/// What lies on the cloth at a vertex, as a render looks it up.
double cloth_at(const Scene &scene, const Opacity &opacity, const Surface &surface,
                std::size_t vertex) {
    const Placement &place = opacity.placement;
    const Texture &picture = scene.textures[opacity.picture.value];
    const glm::dvec2 d = (glm::dvec2(surface.uv[vertex]) - place.origin) / place.width;
    const double c = std::cos(place.turn), s = std::sin(place.turn);
    glm::dvec2 at(c * d.x + s * d.y, -s * d.x + c * d.y);
    at -= glm::floor(at);
    const auto x = static_cast<std::size_t>(at.x * picture.width);
    const auto y = static_cast<std::size_t>((1 - at.y) * picture.height);
    return picture.data.at(y * static_cast<std::size_t>(picture.width) + x) / 255.0;
}

struct Way {
    std::string transform;
    double rotation, scale_u, offset_u;
    std::string keys{};
};

// The picture lies where a viewer of glTF lays it, however the file moves and mirrors it and
// however the cloth is cut.
TEST(FileOpacity, LiesWhereTheFileLaysIt) {
    for (const Way &way :
         {Way{"", 0, 1, 0}, Way{R"("scale":[-1,1],"offset":[1,0])", 0, -1, 1},
          Way{R"("rotation":0.4)", 0.4, 1, 0}, Way{"", 0, 1, 0, "default_grain_deg = 30\n"},
          Way{R"("scale":[-1,1],"offset":[1,0])", 0, -1, 1, "default_grain_deg = 30\n"},
          Way{R"("rotation":0.4)", 0.4, 1, 0, "[garments.square.panels.square]\ngrain_deg = -20\n"},
          Way{"", 0, 1, 0, "metres_per_uv = 0.5\n"}}) {
        const Scratch scratch;
        const BuiltScene built = build(scratch, square("BLEND", way.transform), way.keys);
        const Scene &scene = built.scene;
        ASSERT_EQ(scene.objects[0].panels.size(), 1u);
        const Opacity &opacity = scene.opacities.at(scene.objects[0].panels[0].opacity->value);
        const Surface &surface = scene.surfaces[0];
        int compared = 0;
        for (std::size_t v = 0; v < surface.position.size(); ++v) {
            const double u = surface.position[v].x * way.scale_u, w = 1 - surface.position[v].y;
            const double c = std::cos(way.rotation), s = std::sin(way.rotation);
            glm::dvec2 t(c * u + s * w + way.offset_u, -s * u + c * w);
            t -= glm::floor(t);
            if (glm::clamp(t, 0.05, 0.95) != t)
                continue; // the picture is not the same on both sides of its edge
            ++compared;
            EXPECT_NEAR(cloth_at(scene, opacity, surface, v), alpha_at(t.x, t.y), 0.02)
                << way.transform << " " << way.keys << " " << t.x << " " << t.y;
        }
        EXPECT_GT(compared, 5);
    }
}

TEST(FileOpacity, OfAMaskIsAllOrNothing) {
    const Scratch scratch;
    const BuiltScene built = build(scratch, square("MASK", "", R"(,"alphaCutoff":0.4)"));
    const Scene &scene = built.scene;
    const Texture &picture = scene.textures.at(0);
    double covered = 0;
    for (const std::uint8_t value : picture.data) {
        EXPECT_TRUE(value == 0 || value == 255) << int(value);
        covered += value / 255.0;
    }
    // The area where 0.2 + 0.5 x + 0.25 y is 0.4 or more
    EXPECT_NEAR(covered / static_cast<double>(picture.data.size()), 1 - 0.15, 0.02);
}

TEST(FileOpacity, WithoutAPictureIsTheFactor) {
    const Scratch scratch;
    std::string json = garment::test::square_json(
        "", R"(,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.25]})");
    const BuiltScene built =
        build(scratch, garment::test::glb(json, garment::test::square_buffer()));
    ASSERT_EQ(built.scene.textures.size(), 1u);
    EXPECT_EQ(built.scene.textures[0].data, std::vector<std::uint8_t>{64});
}

TEST(FileOpacity, GivesWayToWhatTheSceneStates) {
    const Scratch scratch;
    const std::string lace = "{ picture = \"my lace.png\", width_m = 0.3 }\n";
    for (const std::string &keys :
         {"opacity = " + lace, "[garments.square.panels.square]\nopacity = " + lace}) {
        const BuiltScene built = build(scratch, square("BLEND", ""), keys);
        ASSERT_EQ(built.scene.opacities.size(), 1u) << keys;
        EXPECT_EQ(built.scene.opacities[0].placement.width, 0.3);
    }
}

TEST(FileOpacity, BodiesHaveThemToo) {
    const Scratch scratch;
    const BuiltScene built = build(scratch, square("BLEND", ""), "", "bodies");
    ASSERT_EQ(built.scene.objects[0].panels.size(), 1u);
    EXPECT_TRUE(built.scene.objects[0].panels[0].opacity);
    EXPECT_FALSE(built.scene.surfaces[0].uv.empty());
}

TEST(FileOpacity, ADamagedPictureIsAnErrorOfTheMesh) {
    const Scratch scratch;
    build(scratch, square("BLEND", ""));
    const std::string bytes = read_file(scratch / "my lace.png");
    write_file(scratch / "my lace.png", bytes.substr(0, bytes.size() / 2));
    try {
        build_scene(read_scene_file(scratch / "s.scene.toml"));
        FAIL();
    } catch (const Error &error) {
        EXPECT_NE(error.problems()[0].where.find("square.glb: 'my%20lace.png'"), std::string::npos)
            << error.what();
    }
}

TEST(FileOpacity, OfATryOn) {
    const Scratch scratch;
    write_picture(scratch / "my lace.png");
    TryOn job{.garment = scratch.write("square.glb", square("BLEND", "")),
              .fabric = scratch.write("f.fabric.toml",
                                      "schema = \"tsuya-fabric 1\"\nname = \"f\"\nmodel = "
                                      "\"ggx\"\n[ggx]\nalpha_weft = 0.3\nalpha_warp = 0.3\n"
                                      "")};
    const Scene scene = make_try_on_scene(job).scene;
    ASSERT_EQ(scene.objects[0].panels.size(), 1u);
    EXPECT_TRUE(scene.objects[0].panels[0].opacity);
}

} // namespace
} // namespace tsuya::scene

#include "tsuya/garment/gltf.h"

#include <gtest/gtest.h>

#include "gltf_samples.h"
#include "test_meshes.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

using test::glb;
using test::square_buffer;
using test::square_json;

MeshFile square(const std::string &node = "", const std::string &material = "",
                const std::string &attributes = "") {
    return parse_gltf(glb(square_json(node, material, attributes), square_buffer()), "m.glb");
}

/// The first problem: `where: what`.
std::string problem(const std::string &bytes, const std::filesystem::path &folder = {}) {
    try {
        parse_gltf(bytes, "m.glb", folder);
    } catch (const Error &error) {
        return error.problems().at(0).where + ": " + error.problems().at(0).what;
    }
    return "no error";
}

glm::dvec3 normal_of(const PolygonMesh &m, std::size_t f) {
    const std::uint32_t *v = &m.corner_position[m.face_offset[f]];
    return glm::normalize(
        glm::cross(m.position[v[1]] - m.position[v[0]], m.position[v[2]] - m.position[v[0]]));
}

TEST(Gltf, ReadsTrianglesWithUvThatRunsUpwards) {
    const MeshFile file = square();
    ASSERT_EQ(file.mesh.face_count(), 2u);
    EXPECT_EQ(file.mesh.panel_name, (std::vector<std::string>{"square"}));
    for (std::size_t c = 0; c < 6; ++c)
        EXPECT_EQ(file.mesh.uv[static_cast<std::size_t>(file.mesh.corner_uv[c])],
                  glm::dvec2(file.mesh.position[file.mesh.corner_position[c]]));
    EXPECT_TRUE(file.hints.empty());
    EXPECT_TRUE(file.morph_targets.empty());
}

TEST(Gltf, NegativeScaleTurnsTheTrianglesOver) {
    const std::string move = R"(,"translation":[5,0,0],"rotation":[0,0,0.70710678,0.70710678])";
    EXPECT_GT(normal_of(square(move + R"(,"scale":[2,2,2])").mesh, 0).z, 0.99);
    const PolygonMesh mirrored = square(move + R"(,"scale":[-2,2,2])").mesh;
    EXPECT_GT(normal_of(mirrored, 0).z, 0.99);
    // The corner (1, 0, 0) goes to (-2, 0, 0), is turned by 90 degrees to (0, -2, 0), and moved.
    EXPECT_LT(glm::distance(mirrored.position[1], glm::dvec3(5, -2, 0)), 1e-6);
    const PolygonMesh matrix = square(R"(,"matrix":[0,3,0,0, 3,0,0,0, 0,0,1,0, 0,0,7,1])").mesh;
    EXPECT_LT(glm::distance(matrix.position[1], glm::dvec3(0, 3, 7)), 1e-12);
    EXPECT_GT(normal_of(matrix, 0).z, 0.99);
}

TEST(Gltf, AppliesTextureTransforms) {
    const std::string material =
        R"(,"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":)"
        R"({"offset":[0.5,0.25],"scale":[2,4],"rotation":1.5707963267948966}}}})";
    const PolygonMesh m = square("", material).mesh;
    // The vertex (1, 0) has the UV (1, 1) in the file: scaled (2, 4), turned (4, -2), moved.
    for (std::size_t c = 0; c < 6; ++c)
        if (m.corner_position[c] == 1) {
            EXPECT_LT(glm::distance(m.uv[static_cast<std::size_t>(m.corner_uv[c])],
                                    glm::dvec2(4.5, 1.0 + 1.75)),
                      1e-12);
        }
}

TEST(Gltf, AnisotropyAndSheenAreHints) {
    const std::string material =
        R"(,"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":0.7,"anisotropyRotation":0.5},)"
        R"("KHR_materials_sheen":{"sheenColorFactor":[0.1,0.2,0.3],"sheenRoughnessFactor":0.4}})";
    for (const std::string attributes : {"", R"(,"TANGENT":2)"}) {
        const MeshFile file = square("", material, attributes);
        ASSERT_EQ(file.hints.size(), 1u);
        const FabricHint &hint = file.hints[0];
        EXPECT_EQ(hint.panel, "square");
        EXPECT_EQ(hint.material, "silk");
        EXPECT_EQ(hint.anisotropy_strength, 0.7);
        EXPECT_NEAR(hint.thread_angle, 0.5 + 90 * kDegree, 1e-6);
        EXPECT_NEAR(hint.grain(), 0.5, 1e-6);
        ASSERT_TRUE(hint.sheen_colour);
        EXPECT_EQ(hint.sheen_colour->y, 0.2f);
    }
}

TEST(Gltf, TheWarpLiesAlongTheThreadsUnlessTheCallerSaysOtherwise) {
    MeshFile file{.mesh = test::panel(4, 4, 0.1)};
    file.mesh.panel_name = {"front"};
    file.hints = {
        {.panel = "front", .anisotropy_strength = 0.7, .thread_angle = 0.5 + 90 * kDegree}};
    const LoadedGarment hinted = load(file, {}, "m.glb");
    const LoadedGarment stated = load(file, {.frames = {.grain = {{"front", 0.0}}}}, "m.glb");
    for (const glm::vec3 &warp : hinted.surface.warp)
        EXPECT_LT(glm::distance(warp, glm::vec3(-std::sin(0.5), std::cos(0.5), 0)), 1e-5f);
    for (const glm::vec3 &warp : stated.surface.warp)
        EXPECT_LT(glm::distance(warp, glm::vec3(0, 1, 0)), 1e-5f);
    EXPECT_EQ(hinted.report.findings.back().key, "fabric_hint");
    EXPECT_EQ(hinted.hints.size(), 1u);
}

TEST(Gltf, TangentsTurnTheThreads) {
    std::string buffer = square_buffer();
    const std::string up = test::bytes_of<float>({0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1, 0, 1});
    buffer.replace(80, up.size(), up);
    const std::string material =
        R"(,"extensions":{"KHR_materials_anisotropy":{"anisotropyStrength":1}})";
    const MeshFile file =
        parse_gltf(glb(square_json("", material, R"(,"TANGENT":2)"), buffer), "m.glb");
    EXPECT_NEAR(file.hints.at(0).grain(), 90 * kDegree, 1e-6);
}

TEST(Gltf, MorphTargetsAreShapes) {
    std::string json = square_json();
    const std::string at = R"("indices":3)";
    json.replace(json.find(at), at.size(), R"("targets":[{"POSITION":0}],"indices":3)");
    const MeshFile file = parse_gltf(glb(json, square_buffer()), "m.glb");
    ASSERT_EQ(file.morph_targets.size(), 1u);
    for (std::size_t v = 0; v < 4; ++v)
        EXPECT_EQ(file.morph_targets[0][v], 2.0 * file.mesh.position[v]);
}

TEST(Gltf, CountsAreHeldAgainstTheFile) {
    const auto with_count = [](const std::string &count) {
        return problem(glb(square_json("", "", "", count), square_buffer()));
    };
    EXPECT_NE(with_count("5").find("m.glb: node 0: primitive 0: POSITION: accessor 0: 5 entries do "
                                   "not fit"),
              std::string::npos)
        << with_count("5");
    for (const std::string count : {"0", "4000000000000", "18446744073709551615", "-1", "1e30"})
        EXPECT_NE(with_count(count), "no error") << count;
    std::string json = square_json();
    json.replace(json.find(R"("byteLength":156)"), 16, R"("byteLength":999)");
    EXPECT_NE(problem(glb(json, square_buffer())), "no error");
}

TEST(Gltf, DamagedFilesAreErrors) {
    const std::string good = glb(square_json(), square_buffer());
    for (std::size_t n = 0; n < good.size(); n += 7)
        EXPECT_NE(problem(good.substr(0, n)), "no error") << n;
    EXPECT_NE(problem("{}"), "no error");
    EXPECT_NE(problem(std::string(100000, '[')), "no error");
    EXPECT_NE(problem(glb(square_json(R"(,"children":[0])"), square_buffer())), "no error");
    EXPECT_NE(problem(glb(square_json(R"(,"children":[7])"), square_buffer())), "no error");
    std::string buffer = square_buffer();
    buffer[144] = 9; // an index
    EXPECT_EQ(problem(glb(square_json(), buffer)),
              "m.glb: node 0: primitive 0: index 9 names no vertex");
    const std::string nan = test::bytes_of<float>({std::nanf("")});
    buffer = square_buffer().replace(0, 4, nan);
    EXPECT_NE(problem(glb(square_json(), buffer)).find("not finite"), std::string::npos);
}

TEST(Gltf, BuffersStayInTheFolder) {
    const auto root = std::filesystem::path(testing::TempDir()) / "gltf_folder";
    std::filesystem::create_directories(root / "inside");
    write_file(root / "secret.bin", square_buffer());
    write_file(root / "inside" / "own.bin", square_buffer());
    const auto json_with = [&](const std::string &uri) {
        std::string json = square_json();
        json.replace(json.find(R"("byteLength":156)"), 16,
                     R"("byteLength":156,"uri":")" + uri + "\"");
        return json;
    };
    write_file(root / "inside" / "m.gltf", json_with("own.bin"));
    EXPECT_EQ(read_gltf(root / "inside" / "m.gltf").mesh.face_count(), 2u);
    for (const std::string uri :
         {"../secret.bin", "..%2Fsecret.bin", "x/../../secret.bin", "/etc/passwd", "file.bin"})
        EXPECT_NE(problem(json_with(uri), root / "inside"), "no error") << uri;
    EXPECT_NE(problem(json_with("../secret.bin"), root / "inside").find("outside the folder"),
              std::string::npos);
    std::filesystem::create_symlink(root / "secret.bin", root / "inside" / "link.bin");
    EXPECT_NE(problem(json_with("link.bin"), root / "inside"), "no error");
    EXPECT_NE(problem(json_with("own.bin")), "no error"); // no folder, no other file
    std::filesystem::remove_all(root);
}

TEST(OutsideData, KhronosSamplesAreRead) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    const auto sample = [&](const std::string &name) {
        return *data / "gltf" / name / "glTF" / (name + ".gltf");
    };
    const MeshFile rotation = read_mesh(sample("AnisotropyRotationTest"));
    EXPECT_GT(rotation.hints.size(), 4u);
    std::size_t turned = 0;
    for (const FabricHint &hint : rotation.hints)
        turned += std::abs(hint.grain()) > 0.1;
    EXPECT_GT(turned, 0u);
    EXPECT_GT(read_mesh(sample("AnisotropyStrengthTest")).hints.size(), 4u);
    // Every ball is as heavy with its own winding: the volume of each part is positive.
    const PolygonMesh scaled = read_mesh(sample("NegativeScaleTest")).mesh;
    EXPECT_GT(scaled.face_count(), 100u);
    for (const char *name :
         {"AnisotropyRotationTest", "AnisotropyStrengthTest", "NegativeScaleTest"})
        check_surface(load(sample(name), {.frames = {.max_degenerate_area = 1.0}}).surface, name);
}

// What is written is what a viewer reads: places, panels, threads.
TEST(Gltf, WritesWhatItReadsBack) {
    const LoadedGarment made =
        load(test::both(test::panel(3, 2, 0.1), test::panel(2, 2, 0.1, {1, 0, 0})),
             {.frames = {.grain = {{"panel1", 0.5}}}}, "t");
    const std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("tsuya-" + std::to_string(getpid()) + ".glb");
    write_glb(path, made.surface,
              {{.name = "satin", .roughness = 0.3, .anisotropy_strength = 0.8},
               {.name = "crepe",
                .roughness = 0.6,
                .anisotropy_strength = 0.5,
                .anisotropy_rotation = 0.25 * kPi}},
              {0, 1});
    const MeshFile back = read_gltf(path);
    std::filesystem::remove(path);
    ASSERT_EQ(back.mesh.panel_name.size(), 2u);
    EXPECT_EQ(back.mesh.panel_label[0].material, "satin");
    EXPECT_EQ(back.mesh.panel_label[1].material, "crepe");
    EXPECT_EQ(back.mesh.face_count(), made.surface.triangle.size());
    EXPECT_EQ(back.mesh.position.size(), made.surface.position.size()); // each once
    ASSERT_EQ(back.hints.size(), 2u);
    EXPECT_NEAR(back.hints[0].anisotropy_strength, 0.8, 1e-6);
    // The highlight is long along the weft, so the warp is the thread that it lies across
    EXPECT_NEAR(std::remainder(back.hints[0].grain(), kPi), 0, 1e-4);
    EXPECT_NEAR(std::remainder(back.hints[1].grain() - 0.25 * kPi, kPi), 0, 1e-4);
    double area = 0;
    for (std::size_t f = 0; f < back.mesh.face_count(); ++f) {
        const std::uint32_t c = back.mesh.face_offset[f];
        const auto place = [&](std::uint32_t k) {
            return back.mesh.position[back.mesh.corner_position[c + k]];
        };
        const auto uv = [&](std::uint32_t k) {
            return back.mesh.uv[static_cast<std::size_t>(back.mesh.corner_uv[c + k])];
        };
        area += 0.5 * glm::cross(place(1) - place(0), place(2) - place(0)).z;
        const glm::dvec2 s = uv(1) - uv(0), t = uv(2) - uv(0);
        EXPECT_GT(s.x * t.y - s.y * t.x, 0) << "the UVs are mirrored";
        EXPECT_NEAR(glm::length(s), glm::length(place(1) - place(0)), 1e-6);
    }
    EXPECT_NEAR(area, 0.06 + 0.04, 1e-3);
}

} // namespace
} // namespace tsuya::garment

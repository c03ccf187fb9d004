// What glTF files of other programs have beyond plain triangles: extensions, nodes, integers.

#include <cstdlib>

#include <gtest/gtest.h>

#include "garment/gltf_problem.h"
#include "tsuya/garment/garment.h"

namespace tsuya::garment {
namespace {

using namespace test;

TEST(GltfExtensions, UnknownRequiredOnesAreRefusedByName) {
    const auto requires_one = [](const std::string &extension) {
        return problem(
            glb(square_with(R"("extensionsRequired":[")" + extension + R"("],)"), square_buffer()));
    };
    EXPECT_EQ(requires_one("ACME_cloth_thing"),
              "m.glb: extensionsRequired: the file requires the extension 'ACME_cloth_thing', "
              "which is not known");
    EXPECT_NE(requires_one("EXT_mesh_gpu_instancing"), "no error");
    for (const char *known : {"KHR_texture_transform", "KHR_mesh_quantization",
                              "KHR_materials_unlit", "KHR_materials_sheen", "KHR_texture_basisu"})
        EXPECT_EQ(requires_one(known), "no error") << known;
    // A file may use what it does not require.
    EXPECT_EQ(
        problem(glb(square_with(R"("extensionsUsed":["ACME_cloth_thing"],)"), square_buffer())),
        "no error");
}

TEST(GltfDocument, OtherVersionsAreRefused) {
    const auto of_version = [](const std::string &version) {
        return problem(
            glb(replaced(square_json(), R"("version":"2.0")", R"("version":")" + version + "\""),
                square_buffer()));
    };
    for (const char *version : {"2.0", "2.1"})
        EXPECT_EQ(of_version(version), "no error");
    for (const std::string version : {"1.0", "3.0", "20", ""})
        EXPECT_EQ(of_version(version), "m.glb: the document is of glTF '" + version + "'");
}

TEST(GltfDocument, AMaterialThatIsNotThereIsAnError) {
    for (const std::string number : {"1", "7", "-2"})
        EXPECT_EQ(problem(glb(replaced(square_json(), R"("material":0)", R"("material":)" + number),
                              square_buffer())),
                  "m.glb: node 0: primitive 0: material " + number + " does not exist");
}

TEST(GltfDocument, ErrorsDoNotQuoteMegabytes) {
    for (const char *start : {"data:application/foo;base64,", "", "../"}) {
        const std::string uri = start + std::string(100000, 'A');
        const std::string told = problem(replaced(square_json(), R"({"byteLength":156})",
                                                  R"({"byteLength":156,"uri":")" + uri + "\"}"));
        EXPECT_NE(told, "no error");
        EXPECT_LT(told.size(), 400u) << told;
    }
}

TEST(GltfNodes, MeshesInNoNodeAreReadOrFound) {
    const std::string no_node = replaced(square_json(), R"([{"mesh":0}])", "[{}]");
    const MeshFile alone = parse_gltf(glb(no_node, square_buffer()), "m.glb");
    EXPECT_EQ(alone.mesh.face_count(), 2u);
    ASSERT_EQ(alone.findings.size(), 1u);
    EXPECT_EQ(alone.findings[0].key, "unplaced_meshes");
    EXPECT_EQ(alone.findings[0].severity, Severity::note);
    const std::string second = replaced(
        square_json(), R"("meshes":[)",
        R"("meshes":[{"name":"other","primitives":[{"attributes":{"POSITION":0},"indices":3}]},)");
    const MeshFile one = parse_gltf(glb(second, square_buffer()), "m.glb");
    EXPECT_EQ(one.mesh.panel_name, (std::vector<std::string>{"other"}));
    ASSERT_EQ(one.findings.size(), 1u);
    EXPECT_EQ(one.findings[0].severity, Severity::warning);
    EXPECT_EQ(one.findings[0].what, "1 mesh stands in no node of the scene: 'square'");
}

TEST(GltfQuantization, IntegersAreReadAsTheAccessorSays) {
    // Positions as normalised shorts of rows of 8 bytes, UVs as plain bytes, placed and scaled by
    // the node and the texture transform.
    const std::string buffer =
        bytes_of<std::int16_t>({0, 0, 0, 9, 32767, 0, 0, 9, 32767, 32767, 0, 9, 0, 32767, 0, 9}) +
        bytes_of<std::uint8_t>({0, 200, 7, 7, 200, 200, 7, 7, 200, 0, 7, 7, 0, 0, 7, 7}) +
        bytes_of<std::uint16_t>({0, 1, 2, 0, 2, 3});
    const std::string json =
        R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_mesh_quantization","KHR_texture_transform"],)"
        R"("scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,2,2]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],)"
        R"("materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":)"
        R"({"KHR_texture_transform":{"scale":[0.01,0.01],"offset":[0,-1]}}}}}],)"
        R"("accessors":[{"bufferView":0,"componentType":5122,"normalized":true,"count":4,"type":"VEC3"},)"
        R"({"bufferView":1,"componentType":5121,"count":4,"type":"VEC2"},)"
        R"({"bufferView":2,"componentType":5123,"count":6,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":32,"byteStride":8},)"
        R"({"buffer":0,"byteOffset":32,"byteLength":16,"byteStride":4},)"
        R"({"buffer":0,"byteOffset":48,"byteLength":12}],"buffers":[{"byteLength":60}]})";
    const PolygonMesh m = parse_gltf(glb(json, buffer), "m.glb").mesh;
    EXPECT_EQ(m.position[2], glm::dvec3(2, 2, 0));
    for (std::size_t c = 0; c < 6; ++c)
        EXPECT_LT(glm::distance(m.uv[static_cast<std::size_t>(m.corner_uv[c])],
                                glm::dvec2(m.position[m.corner_position[c]])),
                  1e-12);
}

TEST(OutsideCases, GltfFilesOfOtherPrograms) {
    const char *cases = std::getenv("TSUYA_TEST_CASES");
    if (!cases || !*cases)
        GTEST_SKIP() << "TSUYA_TEST_CASES does not name a folder";
    const std::filesystem::path folder = std::filesystem::path(cases) / "garment";
    EXPECT_THROW(read_gltf(folder / "53_unknown_required.gltf"), Error);
    EXPECT_EQ(read_gltf(folder / "59_alpha_blend_lace.gltf").findings.at(0).key, "alpha_not_shown");
    // In centimetres with z up, which its one joint turns to metres with y up: 0.6 m high.
    glm::dvec3 lower(1e9), upper(-1e9);
    for (const glm::dvec3 &p : read_gltf(folder / "54_skinned_cm_zup.gltf").mesh.position) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    EXPECT_LT(glm::distance(lower, glm::dvec3(-0.26, 0, -0.26)), 1e-6);
    EXPECT_LT(glm::distance(upper, glm::dvec3(0.26, 0.6, 0.26)), 1e-6);
}

} // namespace
} // namespace tsuya::garment

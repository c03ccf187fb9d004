// What glTF files of other programs have beyond plain triangles: extensions, skins, transparency.

#include <cstdlib>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include "gltf_samples.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

using test::bytes_of;
using test::glb;
using test::square_buffer;
using test::square_json;

/// The first problem: `where: what`.
std::string problem(const std::string &bytes) {
    try {
        parse_gltf(bytes, "m.glb");
    } catch (const Error &error) {
        return error.problems().at(0).where + ": " + error.problems().at(0).what;
    }
    return "no error";
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// The JSON of the square with members before its `scene`.
std::string square_with(const std::string &members, const std::string &node = "",
                        const std::string &material = "") {
    return replaced(square_json(node, material), R"("scene":0)", members + R"("scene":0)");
}

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

std::vector<Finding> findings_of(const std::string &material) {
    return parse_gltf(glb(square_json("", material), square_buffer()), "m.glb").findings;
}

TEST(GltfAlpha, WhatLetsLightThroughIsAFinding) {
    const std::string picture = R"("pbrMetallicRoughness":{"baseColorTexture":{"index":0}})";
    for (const std::string mode : {"MASK", "BLEND"}) {
        const auto findings = findings_of(R"(,"alphaMode":")" + mode + "\"," + picture);
        ASSERT_EQ(findings.size(), 1u);
        EXPECT_EQ(findings[0].key, "alpha_not_shown");
        EXPECT_EQ(findings[0].severity, Severity::warning);
        EXPECT_EQ(findings[0].what, "material 'silk' of panel 'square' has the alphaMode " + mode);
    }
    EXPECT_EQ(findings_of(
                  R"(,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]})")
                  .size(),
              1u);
    EXPECT_TRUE(findings_of(R"(,"alphaMode":"OPAQUE",)" + picture).empty());
    EXPECT_TRUE(findings_of(R"(,"alphaMode":"BLEND")").empty()); // opaque everywhere
}

TEST(GltfAlpha, StrictRefusesIt) {
    const MeshFile file = parse_gltf(
        glb(square_json(
                "",
                R"(,"alphaMode":"MASK","pbrMetallicRoughness":{"baseColorTexture":{"index":0}})"),
            square_buffer()),
        "m.glb");
    EXPECT_EQ(load(file, {}, "m.glb").report.findings.back().key, "alpha_not_shown");
    EXPECT_THROW(load(file, {.strict = true}, "m.glb"), Error);
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

/// The square with skin attributes of four bytes, or shorts, and weights a vertex; two joints: one
/// moved by (10, 0, 0), the other turned by a quarter about z and enlarged. The bind matrices take
/// away (1, 0, 0). The node of the mesh itself is moved far away, which must not count.
template <typename Joint, typename Weight>
std::string skinned_square(int joint_type, int weight_type, const std::vector<Weight> &weights,
                           Joint second = 1, const std::string &target = "") {
    std::string buffer = square_buffer();
    const std::string joints =
        bytes_of<Joint>({0, 0, 0, 0, 0, second, 0, 0, second, 0, 0, 0, 0, second, 0, 0});
    const std::string bind = bytes_of<float>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1,
                                              1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -1, 0, 0, 1});
    const std::string weight_bytes = bytes_of<Weight>(weights);
    const auto view = [&](const std::string &bytes) {
        buffer.resize((buffer.size() + 3) / 4 * 4, '\0');
        const std::string text = R"(,{"buffer":0,"byteOffset":)" + std::to_string(buffer.size()) +
                                 R"(,"byteLength":)" + std::to_string(bytes.size()) + "}";
        buffer += bytes;
        return text;
    };
    const std::string views = view(joints) + view(weight_bytes) + view(bind);
    const bool normalized = weight_type != 5126;
    std::string json =
        square_json(R"(,"skin":0,"translation":[500,0,0])", "", R"(,"JOINTS_0":4,"WEIGHTS_0":5)");
    json = replaced(json, R"("type":"SCALAR"}])",
                    R"("type":"SCALAR"},{"bufferView":4,"componentType":)" +
                        std::to_string(joint_type) + R"(,"count":4,"type":"VEC4"},)" +
                        R"({"bufferView":5,"componentType":)" + std::to_string(weight_type) +
                        R"(,"normalized":)" + (normalized ? "true" : "false") +
                        R"(,"count":4,"type":"VEC4"},)" +
                        R"({"bufferView":6,"componentType":5126,"count":2,"type":"MAT4"}])");
    json = replaced(json, R"("byteOffset":144,"byteLength":12})",
                    R"("byteOffset":144,"byteLength":12})" + views);
    json =
        replaced(json, R"("byteLength":156)", R"("byteLength":)" + std::to_string(buffer.size()));
    json = replaced(json, R"("nodes":[0]}])", R"("nodes":[0,1]}])");
    json = replaced(json, R"("meshes":)",
                    R"("skins":[{"joints":[1,2],"inverseBindMatrices":6}],"meshes":)");
    json = replaced(json, R"([500,0,0]}])",
                    R"([500,0,0]},{"translation":[10,0,0],"children":[2]},)"
                    R"({"rotation":[0,0,0.7071067811865476,0.7071067811865476],"scale":[3,3,3]}])");
    if (!target.empty())
        json = replaced(json, R"("indices":3)", R"("targets":[)" + target + R"(],"indices":3)");
    return glb(json, buffer);
}

void expect_posed(const MeshFile &file) {
    // Vertex 0 follows joint 0 alone, 2 joint 1, 1 and 3 both by halves.
    const glm::dvec3 shift(-1, 0, 0), first(10, 0, 0);
    const auto by_second = [&](glm::dvec3 p) {
        p += shift;
        return first + 3.0 * glm::dvec3(-p.y, p.x, p.z);
    };
    const glm::dvec3 rest[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const glm::dvec3 expected[4] = {
        rest[0] + shift + first, 0.5 * (rest[1] + shift + first) + 0.5 * by_second(rest[1]),
        by_second(rest[2]), 0.5 * (rest[3] + shift + first) + 0.5 * by_second(rest[3])};
    ASSERT_EQ(file.mesh.position.size(), 4u);
    for (std::size_t v = 0; v < 4; ++v)
        EXPECT_LT(glm::distance(file.mesh.position[v], expected[v]), 1e-4) << v;
}

TEST(GltfSkin, VerticesFollowTheirJoints) {
    const std::vector<float> weights{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    expect_posed(parse_gltf(skinned_square<std::uint8_t, float>(5121, 5126, weights), "m.glb"));
    expect_posed(parse_gltf(skinned_square<std::uint16_t, float>(5123, 5126, weights), "m.glb"));
    // Normalised integers; weights that do not sum to 1 count by their share.
    expect_posed(
        parse_gltf(skinned_square<std::uint8_t, std::uint8_t>(
                       5121, 5121, {255, 0, 0, 0, 100, 100, 0, 0, 9, 0, 0, 0, 200, 200, 0, 0}),
                   "m.glb"));
    expect_posed(
        parse_gltf(skinned_square<std::uint8_t, std::uint16_t>(
                       5121, 5123, {65535, 0, 0, 0, 7, 7, 0, 0, 9, 0, 0, 0, 200, 200, 0, 0}),
                   "m.glb"));
}

// glTF 2.0, 5.28: without them, each is the identity.
TEST(GltfSkin, InverseBindMatricesMayBeLeftOut) {
    const std::vector<float> weights{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    std::string file = skinned_square<std::uint8_t, float>(5121, 5126, weights);
    const std::string member = R"(,"inverseBindMatrices":6)";
    file = replaced(file, member, std::string(member.size(), ' '));
    const MeshFile mesh = parse_gltf(file, "m.glb");
    ASSERT_EQ(mesh.mesh.position.size(), 4u);
    EXPECT_LT(glm::distance(mesh.mesh.position[0], glm::dvec3(10, 0, 0)), 1e-4);
    EXPECT_LT(glm::distance(mesh.mesh.position[2], glm::dvec3(10 - 3, 3, 0)), 1e-4);
}

TEST(GltfSkin, MorphTargetsAreAddedBeforeThePose) {
    const std::vector<float> weights{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    const MeshFile file = parse_gltf(
        skinned_square<std::uint8_t, float>(5121, 5126, weights, 1, R"({"POSITION":0})"), "m.glb");
    expect_posed(file);
    // The shape is at (2, 2, 0); joint 1 takes off (1, 0, 0), turns, enlarges and moves it.
    EXPECT_LT(glm::distance(file.morph_targets.at(0).at(2), glm::dvec3(10 - 6, 3, 0)), 1e-4);
}

TEST(GltfSkin, BadSkinsAreErrors) {
    const std::vector<float> weights{1, 0, 0, 0, 0.5f, 0.5f, 0, 0, 1, 0, 0, 0, 0.5f, 0.5f, 0, 0};
    EXPECT_EQ(problem(skinned_square<std::uint8_t, float>(5121, 5126, weights, 2)),
              "m.glb: node 0: primitive 0: JOINTS_0: vertex 1 names joint 2");
    EXPECT_EQ(problem(skinned_square<float, float>(5126, 5126, weights, -7.0f)),
              "m.glb: node 0: primitive 0: JOINTS_0: vertex 1 names joint -7");
    EXPECT_EQ(problem(skinned_square<float, float>(5126, 5126, weights, 0.5f)),
              "m.glb: node 0: primitive 0: JOINTS_0: vertex 1 names joint 0.5");
    std::vector<float> none = weights;
    none[8] = 0;
    EXPECT_EQ(problem(skinned_square<std::uint8_t, float>(5121, 5126, none)),
              "m.glb: node 0: primitive 0: the weights of vertex 2 sum to 0");
    EXPECT_EQ(problem(glb(square_json(R"(,"skin":3)"), square_buffer())),
              "m.glb: node 0: primitive 0: skin 3 does not exist");
    EXPECT_NE(problem(glb(replaced(square_json(R"(,"skin":0)"), R"("meshes":)",
                                   R"("skins":[{"joints":[0]}],"meshes":)"),
                          square_buffer())),
              "no error");
}

/// A strip of `n` quads, 0.1 m each, with UVs in metres, compressed by Draco without loss of more
/// than a step in 2^14.
std::string draco_strip(int n) {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * n);
    const int position =
        builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    const int uv = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
    for (int i = 0; i < 2 * n; ++i) {
        float p[3][3], t[3][2];
        const int corner[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
        for (int c = 0; c < 3; ++c) {
            p[c][0] = t[c][0] = 0.1f * static_cast<float>(i / 2 + corner[i % 2][c][0]);
            p[c][1] = 0.1f * static_cast<float>(corner[i % 2][c][1]);
            t[c][1] = 1.0f - p[c][1];
            p[c][2] = 0;
        }
        const draco::FaceIndex f(static_cast<std::uint32_t>(i));
        builder.SetAttributeValuesForFace(position, f, p[0], p[1], p[2]);
        builder.SetAttributeValuesForFace(uv, f, t[0], t[1], t[2]);
    }
    const auto mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 14);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.size()};
}

std::string draco_glb(const std::string &data) {
    return glb(
        R"({"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"],"scene":0,)"
        R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":)"
        R"({"POSITION":0,"TEXCOORD_0":1},"indices":2,"extensions":{"KHR_draco_mesh_compression":)"
        R"({"bufferView":0,"attributes":{"POSITION":0,"TEXCOORD_0":1}}}}]}],)"
        R"("accessors":[{"componentType":5126,"count":4,"type":"VEC3"},)"
        R"({"componentType":5126,"count":4,"type":"VEC2"},{"componentType":5123,"count":6,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":)" +
            std::to_string(data.size()) + R"(}],"buffers":[{"byteLength":)" +
            std::to_string(data.size()) + "}]}",
        data);
}

TEST(GltfDraco, IsRead) {
    const PolygonMesh m = parse_gltf(draco_glb(draco_strip(5)), "m.glb").mesh;
    EXPECT_EQ(m.face_count(), 10u);
    EXPECT_EQ(m.position.size(), 12u);
    glm::dvec3 upper(0.0);
    for (std::size_t c = 0; c < m.corner_position.size(); ++c) {
        const glm::dvec3 &p = m.position[m.corner_position[c]];
        upper = glm::max(upper, p);
        EXPECT_LT(glm::distance(m.uv[static_cast<std::size_t>(m.corner_uv[c])], glm::dvec2(p)),
                  1e-4);
    }
    EXPECT_LT(glm::distance(upper, glm::dvec3(0.5, 0.1, 0)), 1e-4);
}

TEST(GltfDraco, DamagedDataIsAnError) {
    const std::string data = draco_strip(20);
    for (std::size_t cut = 1; cut < data.size(); cut += 3)
        EXPECT_NE(problem(draco_glb(data.substr(0, cut))).find("m.glb: mesh 0: primitive 0: "),
                  std::string::npos)
            << cut;
    // Ten bytes that declare a billion faces.
    const std::string bomb("DRACO\x02\x02\x01\x00\x00\x00\xFF\xFF\xFF\xFF\x03\x01\x00", 18);
    EXPECT_EQ(problem(draco_glb(bomb)), "m.glb: mesh 0: primitive 0: the Draco data declares more "
                                        "faces than its size allows");
}

/// The square with every buffer view compressed, and a fallback buffer that holds nothing.
std::string meshopt_square(bool damaged) {
    const std::string plain = square_buffer();
    std::string packed, views;
    const auto add = [&](std::size_t offset, std::size_t count, std::size_t stride, bool indices) {
        std::vector<unsigned char> out(1000);
        const auto *from = reinterpret_cast<const unsigned char *>(plain.data() + offset);
        if (indices) {
            const auto *numbers = reinterpret_cast<const std::uint16_t *>(from);
            const std::vector<unsigned> wide(numbers, numbers + count);
            out.resize(meshopt_encodeIndexBuffer(out.data(), out.size(), wide.data(), count));
        } else {
            out.resize(meshopt_encodeVertexBuffer(out.data(), out.size(), from, count, stride));
        }
        packed.resize((packed.size() + 3) / 4 * 4, '\0');
        const std::string bytes = std::to_string(count * stride), to = std::to_string(offset);
        views += std::string(views.empty() ? "" : ",") + R"({"buffer":1,"byteOffset":)" + to +
                 R"(,"byteLength":)" + bytes +
                 (indices ? "" : R"(,"byteStride":)" + std::to_string(stride)) +
                 R"(,"extensions":{"EXT_meshopt_compression":{"buffer":0,"byteOffset":)" +
                 std::to_string(packed.size()) + R"(,"byteLength":)" + std::to_string(out.size()) +
                 R"(,"byteStride":)" + std::to_string(stride) + R"(,"count":)" +
                 std::to_string(count) + R"(,"mode":")" + (indices ? "TRIANGLES" : "ATTRIBUTES") +
                 R"("}}})";
        packed.append(reinterpret_cast<const char *>(out.data()), out.size());
        if (damaged)
            packed.back() = static_cast<char>(packed.back() ^ 0x55), packed[0] = 0;
    };
    add(0, 4, 12, false);
    add(48, 4, 8, false);
    add(80, 4, 16, false);
    add(144, 6, 2, true);
    std::string json = square_json();
    const std::size_t at = json.find(R"("bufferViews")");
    json = json.substr(0, at) +
           R"("extensionsRequired":["EXT_meshopt_compression"],"bufferViews":[)" + views +
           R"(],"buffers":[{"byteLength":)" + std::to_string(packed.size()) +
           R"(},{"byteLength":156,"extensions":{"EXT_meshopt_compression":{"fallback":true}}}]})";
    return glb(json, packed);
}

TEST(GltfMeshopt, ABinaryChunkThatIsCutShortIsAnError) {
    const std::string good = meshopt_square(false);
    for (std::size_t cut = good.size() - 40; cut < good.size(); ++cut)
        EXPECT_NE(problem(good.substr(0, cut)), "no error") << cut;
}

TEST(GltfMeshopt, IsReadAlsoWithoutAFallback) {
    const PolygonMesh m = parse_gltf(meshopt_square(false), "m.glb").mesh;
    const PolygonMesh plain = parse_gltf(glb(square_json(), square_buffer()), "m.glb").mesh;
    EXPECT_EQ(m.position, plain.position);
    EXPECT_EQ(m.face_count(), plain.face_count());
    for (std::size_t c = 0; c < 6; ++c)
        EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[c])],
                  glm::dvec2(m.position[m.corner_position[c]]));
    EXPECT_EQ(problem(meshopt_square(true)), "m.glb: buffer view 0: the meshopt data is damaged");
    EXPECT_EQ(
        problem(replaced(meshopt_square(false), R"("count":4,"mode")", R"("count":9,"mode")")),
        "m.glb: buffer view 0: count and byteStride do not fit the length of the buffer view");
    EXPECT_NE(problem(replaced(meshopt_square(false), R"("mode":"ATTRIBUTES")",
                               R"("mode":"ATTRIBUTED")")),
              "no error");
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

// Compressed glTF files: Draco and meshopt.

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

#include <gtest/gtest.h>

#include "garment/gltf_problem.h"
#include "tsuya/garment/garment.h"

namespace tsuya::garment {
namespace {

using namespace test;

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

} // namespace
} // namespace tsuya::garment

// Skins of glTF files.

#include <gtest/gtest.h>

#include "garment/gltf_problem.h"
#include "tsuya/garment/garment.h"

namespace tsuya::garment {
namespace {

using namespace test;

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

} // namespace
} // namespace tsuya::garment

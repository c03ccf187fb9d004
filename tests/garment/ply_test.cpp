#include "tsuya/garment/ply.h"

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

template <typename Parse> std::string place(Parse &&parse, const std::string &text) {
    try {
        parse(text, "m", {});
    } catch (const Error &error) {
        return error.problems().at(0).where;
    }
    return "no error";
}

std::string ply_header(const std::string &vertices, const std::string &faces) {
    return "ply\nformat ascii 1.0\ncomment made here\nelement vertex " + vertices +
           "\nproperty float x\nproperty float y\nproperty float z\nproperty float u\nproperty "
           "float v\nelement face " +
           faces + "\nproperty list uchar int vertex_indices\nend_header\n";
}

const std::string kVertices = "0 0 0 0 0\n1 0 0 1 0\n1 1 0.5 1 1\n0 1 0 0 1\n";

TEST(Ply, ReadsPolygonsAndUvs) {
    const PolygonMesh m = parse_ply(ply_header("4", "1") + kVertices + "4 0 1 2 3\n", "m");
    ASSERT_EQ(m.face_count(), 1u);
    EXPECT_EQ(m.face_size(0), 4u);
    EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
    EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[3])], glm::dvec2(0, 1));
}

TEST(Ply, DeclaredCountsAndIndicesAreChecked) {
    const std::string body = kVertices + "4 0 1 2 3\n";
    EXPECT_EQ(place(parse_ply, ply_header("4000000000", "1") + body), "m:4");
    EXPECT_EQ(place(parse_ply, ply_header("4", "99999999999") + body), "m:10");
    EXPECT_EQ(place(parse_ply, ply_header("x", "1") + body), "m:4");
    EXPECT_EQ(place(parse_ply, ply_header("5", "1") + body), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "2") + body), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "4 0 1 2 9\n"), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "2 0 1\n"), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "200000000 0 1 2\n"), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + "nan" + body.substr(1)), "m");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1").substr(0, 60)), "m");
    EXPECT_EQ(place(parse_ply, ""), "m");
}

TEST(Ply, WritesWhatItReadsBack) {
    Surface s;
    s.position = {{0, 0, 0.1}, {1, 0, 0}, {0, 1.0 / 3.0, 0}};
    s.normal.assign(3, glm::vec3(0, 0, 1));
    s.warp.assign(3, glm::vec3(0, 1, 0));
    s.weft.assign(3, glm::vec3(1, 0, 0));
    s.uv = {{0, 0}, {1, 0}, {0, 0.1f}};
    s.triangle = {{0, 1, 2}};
    s.panel = {0};
    s.panel_name = {"front"};
    const auto path = std::filesystem::path(testing::TempDir()) / "written.ply";
    write_ply(path, s);
    const PolygonMesh m = read_mesh(path).mesh;
    ASSERT_EQ(m.position.size(), 3u);
    for (std::size_t v = 0; v < 3; ++v)
        EXPECT_LT(glm::distance(m.position[v], s.position[v]), 1e-7); // OpenMesh reads floats
    ASSERT_EQ(m.uv.size(), 3u);
    EXPECT_EQ(glm::vec2(m.uv[2]), s.uv[2]);
    const std::string bytes = read_file(path);
    EXPECT_NE(bytes.find("property float warp_x"), std::string::npos);
    EXPECT_NE(bytes.find("comment panel 0 front"), std::string::npos);
    const std::size_t header = bytes.find("end_header\n") + 11;
    EXPECT_EQ(bytes.size() - header, 3 * (24 + 12 + 8 + 24) + (1 + 12 + 4u));
    for (std::size_t cut = header; cut < bytes.size(); ++cut)
        EXPECT_THROW(parse_ply(bytes.substr(0, cut), "m"), Error) << cut;
    std::filesystem::remove(path);
    EXPECT_THROW(write_ply("/nonexistent/folder/m.ply", s), Error);
}

TEST(Off, ReadsPolygonsAndChecksCounts) {
    const std::string body = "0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n";
    const PolygonMesh m = parse_off("OFF\n4 1 0\n" + body, "m");
    ASSERT_EQ(m.face_count(), 1u);
    EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
    EXPECT_TRUE(m.uv.empty());
    EXPECT_EQ(place(parse_off, "OFF\n4000000000 1 0\n" + body), "m");
    EXPECT_EQ(place(parse_off, "OFF\n4 2 0\n" + body), "m");
    EXPECT_EQ(place(parse_off, "OFF\n5 1 0\n" + body), "m");
    EXPECT_EQ(place(parse_off, "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 7\n"), "m");
    EXPECT_EQ(place(parse_off, "OFF BINARY\n4 1 0\n" + body), "m");
    EXPECT_EQ(place(parse_off, "4 1 0\n" + body), "m");
    EXPECT_EQ(place(parse_off, ""), "m");
}

TEST(OutsideData, LegoIsRead) {
    const auto data = test::outside_data();
    if (!data)
        GTEST_SKIP() << "TSUYA_TEST_DATA does not name a folder";
    const PolygonMesh lego = read_mesh(*data / "pathological/geometry-central/lego.ply").mesh;
    EXPECT_EQ(lego.position.size(), 1649u);
    EXPECT_EQ(lego.face_count(), 3072u);
}

} // namespace
} // namespace tsuya::garment

#include "tsuya/garment/ply.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include <gtest/gtest.h>

#include "gltf_samples.h"
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
    EXPECT_EQ(place(parse_ply, ply_header("5", "1") + body), "m:17");
    EXPECT_EQ(place(parse_ply, ply_header("4", "2") + body), "m:17");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "4 0 1 2 9\n"), "m:17");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "2 0 1\n"), "m:17");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + kVertices + "200000000 0 1 2\n"), "m:17");
    EXPECT_EQ(place(parse_ply, ply_header("4", "1") + "nan" + body.substr(1)), "m:13");
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
    s.panel_name = {"front\nleft"};
    const auto path = std::filesystem::path(testing::TempDir()) / "written.ply";
    write_ply(path, s);
    const PolygonMesh m = read_mesh(path).mesh;
    ASSERT_EQ(m.position.size(), 3u);
    for (std::size_t v = 0; v < 3; ++v)
        EXPECT_EQ(m.position[v], s.position[v]);
    EXPECT_EQ(m.panel_name, (std::vector<std::string>{"front left"}));
    ASSERT_EQ(m.uv.size(), 3u);
    EXPECT_EQ(glm::vec2(m.uv[2]), s.uv[2]);
    const std::string bytes = read_file(path);
    EXPECT_NE(bytes.find("property float warp_x"), std::string::npos);
    EXPECT_NE(bytes.find("comment panel 0 front left"), std::string::npos);
    const std::size_t header = bytes.find("end_header\n") + 11;
    EXPECT_EQ(bytes.size() - header, 3 * (24 + 12 + 8 + 24) + (1 + 12 + 4u));
    for (std::size_t cut = header; cut < bytes.size(); ++cut)
        EXPECT_THROW(parse_ply(bytes.substr(0, cut), "m"), Error) << cut;
    std::filesystem::remove(path);
    EXPECT_THROW(write_ply("/nonexistent/folder/m.ply", s), Error);
}

/// A PLY file of any format, row by row.
class PlyText {
  public:
    PlyText(std::string format, const std::string &declarations)
        : format_(std::move(format)),
          bytes_("ply\nformat " + format_ + " 1.0\n" + declarations + "end_header\n") {}
    template <typename T> PlyText &add(T value) {
        if (format_ == "ascii") {
            bytes_ += std::to_string(value) + " ";
            return *this;
        }
        std::string number = test::bytes_of<T>({value});
        if (format_ == "binary_big_endian")
            std::reverse(number.begin(), number.end());
        bytes_ += number;
        return *this;
    }
    PlyText &end_row() {
        bytes_ += format_ == "ascii" ? "\n" : "";
        return *this;
    }
    const std::string &bytes() const { return bytes_; }

  private:
    std::string format_, bytes_;
};

const std::vector<std::string> kFormats{"ascii", "binary_little_endian", "binary_big_endian"};

/// Two triangles of a square with colours, an element that is not read, and UVs of the corners as
/// MeshLab writes them: the second triangle lies elsewhere in the UV plane where `apart`.
std::string wedge_square(const std::string &format, bool apart) {
    PlyText ply(format,
                "comment VCGLIB generated\nelement vertex 4\nproperty float x\nproperty "
                "float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
                "property uchar blue\nproperty uchar alpha\nelement camera 1\nproperty list "
                "uchar short plan\nproperty double far\nelement face 2\nproperty list uchar "
                "int vertex_indices\nproperty list uchar float texcoord\nproperty int "
                "texnumber\n");
    const float corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (const auto &at : corner) {
        ply.add(at[0]).add(at[1]).add(0.5f);
        for (int i = 0; i < 4; ++i)
            ply.add(std::uint8_t{200});
        ply.end_row();
    }
    ply.add(std::uint8_t{2}).add(std::int16_t{-3}).add(std::int16_t{7}).add(100.0).end_row();
    for (const auto &face : {std::array<int, 3>{0, 1, 2}, {0, 2, 3}}) {
        ply.add(std::uint8_t{3});
        for (const int v : face)
            ply.add(static_cast<std::int32_t>(v));
        ply.add(std::uint8_t{6});
        for (const int v : face)
            ply.add(corner[v][0] + (apart && face[1] == 2 ? 4 : 0)).add(corner[v][1]);
        ply.add(std::int32_t{0}).end_row();
    }
    return ply.bytes();
}

TEST(Ply, ReadsUvsOfCornersInEveryFormat) {
    for (const std::string &format : kFormats) {
        SCOPED_TRACE(format);
        const PolygonMesh m = parse_ply(wedge_square(format, false), "m");
        ASSERT_EQ(m.face_count(), 2u);
        EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
        for (std::size_t c = 0; c < 6; ++c)
            EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[c])],
                      glm::dvec2(m.position[m.corner_position[c]]));
        // Equal UVs of one vertex are one UV index, so the square is one island.
        EXPECT_EQ(m.corner_uv[0], m.corner_uv[3]);
        EXPECT_EQ(uv_islands(m).count, 1u);
        EXPECT_EQ(uv_islands(parse_ply(wedge_square(format, true), "m")).count, 2u);
    }
}

TEST(Ply, CutFilesAreRefusedInEveryFormat) {
    for (const std::string &format : kFormats) {
        const std::string bytes = wedge_square(format, true);
        const std::size_t blanks =
            format == "ascii" ? 12 : 0; // the last number, its blank and line
        for (std::size_t cut = 0; cut + blanks < bytes.size(); ++cut)
            EXPECT_THROW(parse_ply(bytes.substr(0, cut), "m"), Error) << format << " " << cut;
    }
}

TEST(Ply, TextMayBeOfAnyOrigin) {
    const std::string text = wedge_square("ascii", false);
    std::string carriage_returns = text, dos, utf16("\xFF\xFE");
    std::replace(carriage_returns.begin(), carriage_returns.end(), '\n', '\r');
    for (const char c : text) {
        dos += c == '\n' ? "\r\n" : std::string(1, c);
        utf16 += {c, '\0'};
    }
    for (const std::string &file : {"\xEF\xBB\xBF" + text, carriage_returns, dos, utf16}) {
        const PolygonMesh m = parse_ply(file, "m");
        EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
        EXPECT_EQ(m.uv.size(), 6u);
    }
    // The header of a binary file may end its lines so, too; the body begins after them.
    std::string binary = wedge_square("binary_little_endian", false);
    const std::size_t body = binary.find("end_header\n") + 11;
    std::string header = binary.substr(0, body), dos_header;
    for (const char c : header)
        dos_header += c == '\n' ? "\r\n" : std::string(1, c);
    std::replace(header.begin(), header.end(), '\n', '\r');
    for (const std::string &begin : {header, dos_header})
        EXPECT_EQ(parse_ply(begin + binary.substr(body), "m").position[2], glm::dvec3(1, 1, 0.5));
}

TEST(Ply, UvsOfVerticesHaveThreeNames) {
    for (const auto &[u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}}) {
        std::string header = ply_header("4", "1");
        header.replace(header.find("float u\n"), 8, std::string("float ") + u + "\n");
        header.replace(header.find("float v\n"), 8, std::string("float ") + v + "\n");
        const PolygonMesh m = parse_ply(header + kVertices + "4 0 1 2 3\n", "m");
        EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[3])], glm::dvec2(0, 1)) << u;
    }
}

TEST(Ply, UvsOfVerticesThatNoFaceUsesMayBeAnything) {
    const std::string unused = kVertices + "5 5 5 nan inf\n";
    EXPECT_EQ(parse_ply(ply_header("5", "1") + unused + "4 0 1 2 3\n", "m").face_count(), 1u);
    EXPECT_EQ(place(parse_ply, ply_header("5", "1") + unused + "3 0 1 4\n"), "m: vertex 4");
}

TEST(Ply, PanelsKeepTheirNames) {
    const std::string header = "ply\nformat ascii 1.0\ncomment panel 7 left sleeve\ncomment panel "
                               "2 front\nelement vertex 4\nproperty float x\nproperty float "
                               "y\nproperty float z\nelement face 3\nproperty list uchar int "
                               "vertex_index\nproperty uint panel\nend_header\n"
                               "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
    const PolygonMesh m = parse_ply(header + "3 0 1 2 7\n3 0 2 3 2\n3 1 2 3 4000000000\n", "m");
    EXPECT_EQ(m.panel_name, (std::vector<std::string>{"front", "left sleeve", "panel4000000000"}));
    EXPECT_EQ(m.face_panel, (std::vector<std::uint32_t>{1, 0, 2}));
    EXPECT_EQ(m.panel_label[1].group, "left sleeve");
    EXPECT_EQ(place(parse_ply, header + "3 0 1 2 7\n3 0 2 3 -1\n3 1 2 3 0\n"), "m:18");
}

TEST(Ply, ErrorsNameTheRow) {
    const std::string vertices = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float "
                                 "x\nproperty float y\nproperty float z\nelement face 1\n";
    const std::string wedges = vertices + "property list uchar int vertex_indices\nproperty list "
                                          "uchar float texcoord\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(parse_ply(wedges + "3 0 1 2 0\n", "m").corner_uv[0], -1);
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 2 3 0 0 0\n"), "m:14");
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 2 6 0 0 0 0 0 nan\n"), "m:14");
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 2 6 0 0 0 0 0\n"), "m:14");
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 2 0 5\n"), "m:14");
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 1.5 0\n"), "m:14");
    EXPECT_EQ(place(parse_ply, wedges + "3 0 1 two 0\n"), "m:14");
    const auto header = [&](const std::string &line) {
        return place(parse_ply, vertices + line + "\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    };
    EXPECT_EQ(header("property list float int vertex_indices"), "m:8");
    EXPECT_EQ(header("property list uchar int"), "m:8");
    EXPECT_EQ(header("property half weight"), "m:8");
    EXPECT_EQ(header("property int vertex_indices"), "m:7");
    EXPECT_EQ(header("nonsense"), "m:8");
    EXPECT_EQ(place(parse_ply, "ply\nformat ascii_2 1.0\nend_header\n"), "m:2");
    // In bytes there are no lines.
    std::string binary = wedge_square("binary_big_endian", false);
    binary[binary.size() - 5 - 24 - 1 - 4] = 9; // a corner of the last face
    EXPECT_EQ(place(parse_ply, binary), "m: face 1");
}

TEST(OutsideCases, PlyFilesOfMeshLabAreRead) {
    const char *cases = std::getenv("TSUYA_TEST_CASES");
    if (!cases || !*cases)
        GTEST_SKIP() << "TSUYA_TEST_CASES does not name a folder";
    const std::filesystem::path folder = std::filesystem::path(cases) / "garment";
    for (const char *file : {"40_wedge_uv.ply", "42_texture_uv.ply"}) {
        const PolygonMesh m = read_mesh(folder / file).mesh;
        EXPECT_EQ(m.face_count(), 288u);
        EXPECT_EQ(std::count(m.corner_uv.begin(), m.corner_uv.end(), -1), 0) << file;
    }
}

TEST(Off, ReadsPolygonsAndChecksCounts) {
    const std::string body = "0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n";
    const PolygonMesh m = parse_off("OFF\n4 1 0\n" + body, "m");
    ASSERT_EQ(m.face_count(), 1u);
    EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
    EXPECT_TRUE(m.uv.empty());
    EXPECT_EQ(place(parse_off, "OFF\n4000000000 1 0\n" + body), "m:2");
    EXPECT_EQ(place(parse_off, "OFF\n4 2 0\n" + body), "m:7");
    EXPECT_EQ(place(parse_off, "OFF\n5 1 0\n" + body), "m:7");
    EXPECT_EQ(place(parse_off, "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0.5\n0 1 0\n4 0 1 2 7\n"), "m:7");
    EXPECT_EQ(place(parse_off, "OFF\n4 1 0\n0 0 0\n1 0\n1 1 0.5\n0 1 0\n4 0 1 2 3\n"), "m:4");
    EXPECT_EQ(place(parse_off, "OFF\n4 1 0\n0 0 0\n1 0 nan\n1 1 0.5\n0 1 0\n4 0 1 2 3\n"), "m:4");
    EXPECT_EQ(place(parse_off, "4 1 0\n" + body), "m:1");
    EXPECT_EQ(place(parse_off, "OFF\n"), "m:1");
    EXPECT_EQ(place(parse_off, ""), "m:0");
}

TEST(Off, ReadsItsVariants) {
    const std::string text = "# made here\n\nSTCNOFF # UV, colour, normal\n# counts\n3 1 0\n"
                             "0 0 0  0 0 1  1 0 0  0 0\r\n1 0 0  0 0 1  1 0 0 0.5  1 0 # second\n\n"
                             "0 2 0  0 0 1  1 0 0  0 1\n3 0 1 2 0.5 0.5 0.5\n";
    const PolygonMesh m = parse_off(text, "m");
    EXPECT_EQ(m.position[2], glm::dvec3(0, 2, 0));
    EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[1])], glm::dvec2(1, 0));
    EXPECT_EQ(m.uv[static_cast<std::size_t>(m.corner_uv[2])], glm::dvec2(0, 1));
    const PolygonMesh divided = parse_off("4OFF 3 1 0\n0 0 0 2\n1 0 0 2\n0 1 0 2\n3 0 1 2\n", "m");
    EXPECT_EQ(divided.position[1], glm::dvec3(0.5, 0, 0));
    EXPECT_EQ(place(parse_off, "4OFF 3 1 0\n0 0 0 2\n1 0 0 0\n0 1 0 2\n3 0 1 2\n"), "m:3");
    EXPECT_EQ(place(parse_off, "COFFIN\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"), "m:1");
}

template <typename T> std::string big_endian(const std::vector<T> &numbers) {
    std::string out;
    for (const T number : numbers) {
        std::string bytes = test::bytes_of<T>({number});
        out.append(bytes.rbegin(), bytes.rend());
    }
    return out;
}

TEST(Off, ReadsBinary) {
    const std::string bytes = "OFF BINARY\n" + big_endian<std::int32_t>({4, 2, 0}) +
                              big_endian<float>({0, 0, 0, 1, 0, 0, 1, 1, 0.5f, 0, 1, 0}) +
                              big_endian<std::int32_t>({3, 0, 1, 2, 3}) +
                              big_endian<float>({1, 0, 0}) +
                              big_endian<std::int32_t>({3, 0, 2, 3, 0});
    const PolygonMesh m = parse_off(bytes, "m");
    ASSERT_EQ(m.face_count(), 2u);
    EXPECT_EQ(m.position[2], glm::dvec3(1, 1, 0.5));
    EXPECT_EQ(m.corner_position, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    for (std::size_t cut = 0; cut < bytes.size(); ++cut)
        EXPECT_THROW(parse_off(bytes.substr(0, cut), "m"), Error) << cut;
    std::string other = bytes;
    other[other.size() - 5] = 9;
    EXPECT_EQ(place(parse_off, other), "m: face 1");
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

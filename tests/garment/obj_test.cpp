#include <filesystem>

#include <unistd.h>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {
namespace {

std::vector<std::string> places(const std::string &text) {
    try {
        parse_obj(text, "m.obj");
    } catch (const Error &error) {
        std::vector<std::string> where;
        for (const Problem &p : error.problems())
            where.push_back(p.where);
        return where;
    }
    return {"no error"};
}

const std::string kThree = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(Obj, ReadsPolygonsOfAnySizeWithAndWithoutUv) {
    const PolygonMesh m =
        parse_obj(kThree + "v 1 1 0\nv 2 2 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                           "f 1/1 2/2 3/3\nf 1 2 4 3\nf 1//1 2//1 4//1 5//1 3//1\n",
                  "m.obj");
    ASSERT_EQ(m.face_count(), 3u);
    EXPECT_EQ(m.face_size(2), 5u);
    EXPECT_EQ(m.corner_uv[2], 2);
    EXPECT_EQ(m.corner_uv[3], -1);
    EXPECT_TRUE(m.panel_name.empty());
}

TEST(Obj, ReadsNegativeIndicesContinuationsCrlfAndUnknownLines) {
    const PolygonMesh m = parse_obj(
        "# head\r\nmtllib a.mtl\r\nv 1e0 +2 .5 0.5\r\nv 0 0 \\\r\n 0 1 0 0\r\nbare text\r\n"
        "v 1 0 0 # a comment\r\nvt 0.5\r\nf -3/-1 \\\r\n 2/1/7 -1/1\r\n",
        "m.obj");
    ASSERT_EQ(m.face_count(), 1u);
    EXPECT_EQ(m.position[0], glm::dvec3(2, 4, 1));
    EXPECT_EQ(m.corner_position, (std::vector<std::uint32_t>{0, 1, 2}));
    EXPECT_EQ(m.uv[0], glm::dvec2(0.5, 0));
}

TEST(Obj, PrefersGroupsThenObjectsThenMaterialsAsPanels) {
    const std::string faces = "g left\nf 1 2 3\ng right\nf 1 3 2\n";
    EXPECT_EQ(parse_obj(kThree + "o dress\nusemtl silk\n" + faces, "m").panel_name,
              (std::vector<std::string>{"left", "right"}));
    // One group for all tells nothing apart, the materials do.
    EXPECT_EQ(parse_obj(kThree + "g all\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 2\n", "m").panel_name,
              (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(parse_obj(kThree + "o dress\nf 1 2 3\n", "m").panel_name,
              (std::vector<std::string>{"dress"}));
}

TEST(Obj, SharesEqualUvsOfOneVertex) {
    const PolygonMesh m =
        parse_obj(kThree + "v 1 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 0\nvt 0 1\nvt 1 1\n"
                           "f 1/1 2/2 3/3\nf 2/4 4/6 3/5\n",
                  "m.obj");
    EXPECT_EQ(m.corner_uv, (std::vector<std::int32_t>{0, 1, 2, 1, 5, 2}));
}

TEST(Obj, FurtherNumbersOfAVertexAreWOrAColour) {
    const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
    EXPECT_EQ(parse_obj("v 3 6 9 3\n" + rest, "m").position[0], glm::dvec3(1, 2, 3));
    EXPECT_EQ(parse_obj("v 3 6 9 -1.5 # mirrored\n" + rest, "m").position[0],
              glm::dvec3(-2, -4, -6));
    EXPECT_EQ(parse_obj("v 3 6 9 0.5 0.5 0.5\n" + rest, "m").position[0], glm::dvec3(3, 6, 9));
    EXPECT_EQ(parse_obj("v 3 6 9 0.5 0 0 1\n" + rest, "m").position[0], glm::dvec3(3, 6, 9));
    EXPECT_EQ(places("v 3 6 9 0\n" + rest), (std::vector<std::string>{"m.obj:1:9"}));
    EXPECT_EQ(places("v 3 6 9 1 1\n" + rest), (std::vector<std::string>{"m.obj:1:9"}));
    EXPECT_EQ(places("v 3 6 9 1 1 1 1 1\n" + rest), (std::vector<std::string>{"m.obj:1:9"}));
    EXPECT_EQ(places("v 3 6 9 w\n" + rest), (std::vector<std::string>{"m.obj:1:9"}));
}

TEST(Obj, UvsThatNoFaceUsesMayBeAnything) {
    const std::string uvs = kThree + "vt 0 0\nvt 1 0\nvt 0 1\nvt nan 0\nvt 0.5 -inf\n"
                                     "vt -1.#IND -1.#IND\n";
    EXPECT_EQ(parse_obj(uvs + "f 1/1 2/2 3/3\n", "m").corner_uv,
              (std::vector<std::int32_t>{0, 1, 2}));
    EXPECT_EQ(places(uvs + "f 1/1 2/2 3/4\n"), (std::vector<std::string>{"m.obj:7:4"}));
    EXPECT_EQ(places(uvs + "f 1/1 2/5 3/6\n"),
              (std::vector<std::string>{"m.obj:8:8", "m.obj:9:4"}));
    EXPECT_EQ(places(uvs + "vt one 0\nf 1/1 2/2 3/3\n"), (std::vector<std::string>{"m.obj:10:4"}));
}

TEST(Obj, KeepsMoreThan65535Groups) {
    std::string text = kThree;
    constexpr std::uint32_t kGroups = 70000;
    for (std::uint32_t i = 0; i < kGroups; ++i)
        text += "g piece" + std::to_string(i) + "\nf 1 2 3\n";
    const PolygonMesh m = parse_obj(text, "m");
    ASSERT_EQ(m.panel_name.size(), kGroups);
    EXPECT_EQ(m.panel_name.back(), "piece69999");
    EXPECT_EQ(m.face_panel.back(), kGroups - 1);
}

TEST(Obj, BadInputNamesLineAndColumn) {
    EXPECT_EQ(places("v 0 0 0\nv nan 0 0\n"), (std::vector<std::string>{"m.obj:2:3"}));
    EXPECT_EQ(places("v 0 -inf 0\n"), (std::vector<std::string>{"m.obj:1:5"}));
    EXPECT_EQ(places("v 0 1e999 0\n"), (std::vector<std::string>{"m.obj:1:5"}));
    EXPECT_EQ(places("v 0 1.#IND 0\n"), (std::vector<std::string>{"m.obj:1:5"}));
    try {
        parse_obj("v 0 0 " + std::string(1000, 'x') + "\n", "m.obj");
        FAIL();
    } catch (const Error &error) { // a word is shown in part
        EXPECT_LT(std::string(error.what()).size(), 200u);
    }
    EXPECT_EQ(places("v 0 0\n"), (std::vector<std::string>{"m.obj:1:6"}));
    EXPECT_EQ(places("vt x 0\n"), (std::vector<std::string>{"m.obj:1:4"}));
    EXPECT_EQ(places(kThree + "f 1 2 0\n"), (std::vector<std::string>{"m.obj:4:7"}));
    EXPECT_EQ(places(kThree + "f 1 2 4\n"), (std::vector<std::string>{"m.obj:4:7"}));
    EXPECT_EQ(places(kThree + "f 1 2 -4\n"), (std::vector<std::string>{"m.obj:4:7"}));
    EXPECT_EQ(places(kThree + "f 1 2/1 3\n"), (std::vector<std::string>{"m.obj:4:7"}));
    EXPECT_EQ(places(kThree + "  f 1 2\n"), (std::vector<std::string>{"m.obj:4:3"}));
    EXPECT_EQ(places(kThree + "f 1 2 3x\n"), (std::vector<std::string>{"m.obj:4:8"}));
    EXPECT_EQ(places(kThree + "f 1 2 99999999999999999999\n"),
              (std::vector<std::string>{"m.obj:4:7"}));
    EXPECT_EQ(places("v 1 2 3\nf \\\n1 1 9\n"), (std::vector<std::string>{"m.obj:3:5"}));
    EXPECT_EQ(places(kThree), (std::vector<std::string>{"m.obj"}));
    EXPECT_EQ(places(""), (std::vector<std::string>{"m.obj"}));
}

TEST(Obj, CollectsUpToTwentyProblems) {
    EXPECT_EQ(places("v a 0 0\nv 0 b 0\nv 0 0 c\n").size(), 3u);
    std::string many;
    for (int i = 0; i < 50; ++i)
        many += "v x 0 0\n";
    EXPECT_EQ(places(many).size(), kMaxProblems);
}

/// What read_obj makes of a text in a file: where each problem is, or the mesh.
std::vector<std::string> places_in_file(const std::string &text, PolygonMesh *mesh = nullptr) {
    const auto path = std::filesystem::path(testing::TempDir()) / "blocks.obj";
    write_file(path, text);
    std::vector<std::string> where;
    try {
        const PolygonMesh read = read_obj(path);
        if (mesh)
            *mesh = read;
        where = {"no error"};
    } catch (const Error &error) {
        for (const Problem &p : error.problems())
            where.push_back("m.obj" + p.where.substr(path.string().size()));
    }
    std::filesystem::remove(path);
    return where;
}

TEST(Obj, ReadsLargeFilesInBlocksAsIfAtOnce) {
    // Several blocks of a megabyte: lines of all lengths, many of them continued over line ends.
    std::string text;
    for (int i = 0; i < 60000; ++i) {
        const std::string n = std::to_string(i);
        text += i % 3 ? "v " + n + " 0 1\n" : "v " + n + " \\\r\n 0 \\\n 1 # comment \r\n";
        text += "vt " + n + " 0.5\nf -1/-1 1/1 \\\n" + std::to_string(i / 2 + 1) + "/1\n";
        if (i % 1000 == 0)
            text += "g panel" + n + "\n# " + std::string(static_cast<std::size_t>(i), '-') + "\n";
    }
    ASSERT_GT(text.size(), 4u << 20);
    for (const std::string &end : {std::string(), std::string("\n\n"), std::string("v 1 2 3"),
                                   "v 1 2 3 1." + std::string(3 << 20, '0')}) {
        PolygonMesh read;
        const PolygonMesh expected = parse_obj(text + end, "m.obj");
        EXPECT_EQ(places_in_file(text + end, &read), places(text + end));
        EXPECT_EQ(read.position, expected.position);
        EXPECT_EQ(read.uv, expected.uv);
        EXPECT_EQ(read.face_offset, expected.face_offset);
        EXPECT_EQ(read.corner_position, expected.corner_position);
        EXPECT_EQ(read.corner_uv, expected.corner_uv);
        EXPECT_EQ(read.face_panel, expected.face_panel);
        EXPECT_EQ(read.panel_name, expected.panel_name);
    }
    // One line of three megabytes, continued, and what is wrong behind it and in the last line.
    text += "f";
    for (int i = 0; i < 600000; ++i)
        text += " 1 \\\n";
    text += "x\nvt 1\nf 1 2\n f 1 2 3/70000";
    EXPECT_EQ(places_in_file(text), places(text));
    EXPECT_EQ(places(text).size(), 3u);
}

TEST(Obj, ReadsFilesOfAnyEncodingAlike) {
    const std::string text = "v 9 9 9\n" + kThree + "g a\nf 2 3 4\n";
    std::string lone_returns = text, wide = "\xFF\xFE";
    std::replace(lone_returns.begin(), lone_returns.end(), '\n', '\r');
    for (const char c : text)
        wide += {c, '\0'};
    for (const std::string &bytes : {text, "\xEF\xBB\xBF" + text, lone_returns, wide}) {
        PolygonMesh read;
        EXPECT_EQ(places_in_file(bytes, &read), std::vector<std::string>{"no error"});
        ASSERT_EQ(read.position.size(), 4u);
        EXPECT_EQ(read.position[0], glm::dvec3(9));
        EXPECT_EQ(read.corner_position, (std::vector<std::uint32_t>{1, 2, 3}));
    }
    EXPECT_EQ(places_in_file("\xEF\xBB\xBFv 0 x 0\r\r"), std::vector<std::string>{"m.obj:1:5"});
}

TEST(Obj, EscapesNamesOfACodePage) {
    // The second name ends in the byte of a backslash, as a character of Shift JIS may.
    PolygonMesh read;
    const std::string text = kThree + "g \xBE\xD5\nf 1 2 3\ng \x95\x5C\nf 1 3 2\n";
    EXPECT_EQ(places_in_file(text, &read), std::vector<std::string>{"no error"});
    EXPECT_EQ(read.panel_name, (std::vector<std::string>{"\\xBE\\xD5", "\\x95\\x5C"}));
}

TEST(Obj, MissingFileIsAnError) {
    try {
        read_obj("/nonexistent/m.obj");
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().at(0).where, "/nonexistent/m.obj");
    }
}

TEST(Obj, WritesWhatItReadsBack) {
    Surface s;
    s.position = {{0, 0, 0.1}, {1, 0, 0}, {0, 1.0 / 3.0, 0}};
    s.normal.assign(3, glm::vec3(0, 0, 1));
    s.uv = {{0, 0}, {1, 0}, {0, 0.1f}};
    s.triangle = {{0, 1, 2}};
    s.panel = {0};
    s.panel_name = {"front"};
    const auto path = std::filesystem::path(testing::TempDir()) / "written.obj";
    write_obj(path, s);
    const PolygonMesh m = read_obj(path);
    EXPECT_EQ(m.position, s.position);
    EXPECT_EQ(m.panel_name, s.panel_name);
    ASSERT_EQ(m.uv.size(), 3u);
    EXPECT_EQ(glm::vec2(m.uv[2]), s.uv[2]);
    std::filesystem::remove(path);
    EXPECT_THROW(write_obj("/nonexistent/folder/m.obj", s), Error);
}

TEST(PolygonMesh, BadIndicesAreErrors) {
    PolygonMesh m = test::cube();
    check_indices(m, "cube");
    m.corner_position[3] = 8;
    EXPECT_THROW(check_indices(m, "cube"), Error);
    m = test::cube();
    m.corner_uv[3] = 0;
    EXPECT_THROW(check_indices(m, "cube"), Error);
    m = test::cube();
    m.position[2].y = std::nan("");
    EXPECT_THROW(check_indices(m, "cube"), Error);
    m = test::cube();
    m.face_offset[2] = m.face_offset[1] + 2;
    EXPECT_THROW(check_indices(m, "cube"), Error);
}

TEST(MeshFile, AFormatOfAnotherProgramIsRefusedWithAWayOut) {
    for (const char *const extension : {".fbx", ".USDZ", ".zprj"}) {
        const std::filesystem::path path = std::filesystem::temp_directory_path() /
                                           ("tsuya-mesh-" + std::to_string(getpid()) + extension);
        write_file(path, "anything");
        try {
            read_mesh(path);
            ADD_FAILURE() << path;
        } catch (const Error &error) {
            EXPECT_NE(error.problems()[0].accepted.find("EXPORT.md"), std::string::npos);
            EXPECT_EQ(error.problems()[0].where, path.string());
        }
        std::filesystem::remove(path);
    }
}

} // namespace
} // namespace tsuya::garment

#include "tsuya/garment/interchange.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <fstream>

#include <gtest/gtest.h>

#include "garment/interchange_samples.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

class Interchange : public testing::Test {
  protected:
    void SetUp() override {
#ifndef TSUYA_HAS_ASSIMP
        GTEST_SKIP() << "built without Assimp";
#endif
    }
    std::filesystem::path write(const std::string &name, const std::string &text) const {
        const std::filesystem::path path = folder_ / name;
        std::ofstream(path, std::ios::binary) << text;
        return path;
    }
    MeshFile read(const std::string &name, const std::string &text) const {
        return read_mesh(write(name, text));
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

  private:
    std::filesystem::path folder_ = [] {
        std::string name = (std::filesystem::temp_directory_path() / "tsuyaXXXXXX").string();
        return std::filesystem::path(mkdtemp(name.data()));
    }();
};

const Finding *find(const std::vector<Finding> &findings, const std::string &key) {
    for (const Finding &finding : findings)
        if (finding.key == key)
            return &finding;
    return nullptr;
}

std::string replaced(std::string text, const std::string &what, const std::string &by) {
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), by);
}

using Names = std::vector<std::string>;

void expect_sample(const MeshFile &file) {
    const PolygonMesh &mesh = file.mesh;
    EXPECT_EQ(mesh.position.size(), 8u); // as in the file: corners are joined again
    EXPECT_EQ(mesh.panel_name, (Names{"Front/satin", "Front/lining"}));
    EXPECT_EQ(mesh.panel_label[0].object, "Front");
    EXPECT_EQ(mesh.panel_label[1].material, "lining");
    ASSERT_EQ(mesh.face_count(), 3u);
    std::multiset<std::pair<std::uint32_t, std::string>> faces;
    for (std::size_t f = 0; f < 3; ++f)
        faces.emplace(mesh.face_size(f), mesh.panel_name[mesh.face_panel[f]]);
    EXPECT_EQ(faces,
              (decltype(faces){{4, "Front/satin"}, {5, "Front/satin"}, {5, "Front/lining"}}));
    // In metres with y up, after a translation of 1 m upwards: u = x, v = y - 1
    for (std::size_t c = 0; c < mesh.corner_position.size(); ++c) {
        const glm::dvec3 p = mesh.position[mesh.corner_position[c]];
        const glm::dvec2 t = mesh.uv[static_cast<std::size_t>(mesh.corner_uv[c])];
        EXPECT_LT(glm::distance(p, glm::dvec3(t.x, 1 + t.y, 0)), 1e-6) << c;
    }
    const Finding *const units = find(file.findings, "file_units");
    ASSERT_TRUE(units);
    EXPECT_EQ(units->what, "the file is in units of 0.01 m with z up");
    EXPECT_FALSE(find(file.findings, "not_read"));
    EXPECT_FALSE(find(file.findings, "skin_not_applied"));
    EXPECT_FALSE(find(file.findings, "importer_remarks"));
}

TEST_F(Interchange, FbxKeepsPolygonsUvsMaterialsAndUnits) {
    const MeshFile file = read("a.fbx", test::kFbx);
    expect_sample(file);
    const Finding *const sets = find(file.findings, "uv_sets");
    ASSERT_TRUE(sets);
    EXPECT_EQ(sets->what, "a mesh has 2 UV sets");
    // The finding of the file reaches who loads it
    EXPECT_TRUE(find(load(file, {}, "a").report.findings, "uv_sets"));
}

TEST_F(Interchange, FbxOfOtherAxes) {
    std::string metres = replaced(test::kFbx, "\"Number\", \"\",1\n", "\"Number\", \"\",100\n");
    metres = replaced(metres, "\"UpAxis\", \"int\", \"Integer\", \"\",2",
                      "\"UpAxis\", \"int\", \"Integer\", \"\",1");
    metres = replaced(metres, "\"FrontAxis\", \"int\", \"Integer\", \"\",1",
                      "\"FrontAxis\", \"int\", \"Integer\", \"\",2");
    metres = replaced(metres, "\"FrontAxisSign\", \"int\", \"Integer\", \"\",-1",
                      "\"FrontAxisSign\", \"int\", \"Integer\", \"\",1");
    const MeshFile file = read("m.fbx", metres);
    EXPECT_FALSE(find(file.findings, "file_units"));
    double highest = 0;
    for (const glm::dvec3 &p : file.mesh.position)
        highest = std::max(highest, p.z);
    EXPECT_DOUBLE_EQ(highest, 175);
    // Nonsense axes are not followed
    EXPECT_EQ(read("n.fbx", replaced(metres, "\"UpAxis\", \"int\", \"Integer\", \"\",1",
                                     "\"UpAxis\", \"int\", \"Integer\", \"\",7"))
                  .mesh.position,
              file.mesh.position);
}

TEST_F(Interchange, ColladaKeepsPolygonsUvsMaterialsAndUnits) {
    expect_sample(read("a.dae", test::kCollada));
    EXPECT_FALSE(find(
        read("m.dae", replaced(replaced(test::kCollada, "0.01", "1"), "Z_UP", "Y_UP")).findings,
        "file_units"));
}

TEST_F(Interchange, ColladaNamesBeforeIds) {
    const auto first = [&](const std::string &what, const std::string &by) {
        return read("n.dae", replaced(test::kCollada, what, by)).mesh.panel_label.at(0);
    };
    EXPECT_EQ(first("name=\"Front\"", "name=\"Front Panel\"").object, "Front Panel");
    EXPECT_EQ(first("name=\"cloth\"", "name=\"Front Cloth\"").group, "Front Cloth");
    EXPECT_EQ(first("name=\"satin\"", "name=\"Red Satin\"").material, "Red Satin");
    // An id where there is no name
    EXPECT_EQ(first(" name=\"Front\"", "").object, "n-0");
    EXPECT_EQ(first("id=\"n-0\" name=\"Front\"", "sid=\"s-0\"").object, "s-0");
    EXPECT_EQ(first("id=\"n-0\" name=\"Front\"", "").object, "");
    EXPECT_EQ(first(" name=\"satin\"", "").material, "m-0");
}

TEST_F(Interchange, AMirroredInstanceIsTurnedOver) {
    const std::string node = R"(<node id="Back" name="Back"><scale>-1 1 1</scale>)"
                             R"(<instance_geometry url="#g"/></node></visual_scene>)";
    const MeshFile file = read("a.dae", replaced(test::kCollada, "</visual_scene>", node));
    const PolygonMesh &mesh = file.mesh;
    ASSERT_EQ(mesh.face_count(), 6u);
    EXPECT_EQ(mesh.position.size(), 16u); // of two nodes
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        double twice_area = 0;
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            twice_area += glm::cross(mesh.position[mesh.corner_position[c]],
                                     mesh.position[mesh.corner_position[mesh.next(f, c)]])
                              .z;
        EXPECT_GT(twice_area, 0) << f;
    }
}

TEST_F(Interchange, WhatIsLeftOutIsTold) {
    const std::string lines =
        R"(<lines count="1"><input semantic="VERTEX" source="#v" offset="0"/>)"
        R"(<p>0 1</p></lines></mesh>)";
    const MeshFile file = read("l.dae", replaced(test::kCollada, "</mesh>", lines));
    EXPECT_EQ(file.mesh.face_count(), 3u);
    const Finding *const left = find(file.findings, "not_read");
    ASSERT_TRUE(left);
    EXPECT_EQ(left->what, "the file has what is not read: 1 x point or line");
}

std::string facets(const std::string &name, float x) {
    std::string text = "solid " + name + "\n";
    for (const char *const y : {"0", "1"}) {
        const std::string a = std::to_string(x), b = std::to_string(x + 1);
        text += "facet normal 0 0 1\nouter loop\nvertex " + a + " 0 0\nvertex " + b +
                (*y == '0' ? " 0 0\nvertex " : " 1 0\nvertex ") +
                (*y == '0' ? b + " 1 0\n" : a + " 1 0\n") + "endloop\nendfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

TEST_F(Interchange, StlAsText) {
    const MeshFile file = read("a.stl", facets("front", 0) + facets("back", 5));
    EXPECT_EQ(file.mesh.face_count(), 4u);
    EXPECT_EQ(file.mesh.position.size(), 8u);
    EXPECT_EQ(file.mesh.panel_name, (Names{"front", "back"}));
    EXPECT_TRUE(file.mesh.uv.empty());
    const Finding *const units = find(file.findings, "file_units");
    ASSERT_TRUE(units);
    EXPECT_NE(units->action.find("--unit"), std::string::npos);
    const LoadedGarment loaded = load(file, {.frames = {.invented_grain = 0}}, "a.stl");
    EXPECT_NEAR(loaded.surface.warp.front().y, 1, 1e-6);
    const Finding *const no_uv = find(loaded.report.findings, "no_uv");
    ASSERT_TRUE(no_uv);
    EXPECT_NE(no_uv->action.find("--grain"), std::string::npos);
}

TEST_F(Interchange, StlAsTextInUpperCase) {
    std::string text = facets("front", 0);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    const MeshFile file = read("a.stl", replaced(text, "FRONT", "Front"));
    EXPECT_EQ(file.mesh.face_count(), 2u);
    EXPECT_EQ(file.mesh.panel_name, (Names{"Front"}));
}

std::string binary_stl(std::uint32_t declared) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto &value) {
        bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
    };
    append(declared);
    for (const std::array<float, 12> &facet :
         {std::array<float, 12>{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
          std::array<float, 12>{0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0}}) {
        append(facet);
        append(std::uint16_t{0});
    }
    return bytes;
}

TEST_F(Interchange, StlAsNumbers) {
    const MeshFile file = read("b.STL", binary_stl(2));
    EXPECT_EQ(file.mesh.face_count(), 2u);
    EXPECT_EQ(file.mesh.position.size(), 4u);
    // What follows the last facet is not read; a title may begin as a text does
    for (const std::string &after : {std::string("\n"), std::string(777, 'x')})
        EXPECT_EQ(read("b.stl", binary_stl(2) + after).mesh.face_count(), 2u);
    EXPECT_EQ(read("b.stl", "solid" + binary_stl(2).substr(5)).mesh.face_count(), 2u);
}

TEST_F(Interchange, StlOfAnotherSizeThanItsCountIsAnError) {
    const auto expect = [&](const std::string &bytes, const std::string &what,
                            const std::string &accepted) {
        try {
            read("c.stl", bytes);
            ADD_FAILURE() << what;
        } catch (const Error &error) {
            EXPECT_TRUE(error.problems()[0].where.ends_with("c.stl"));
            EXPECT_NE(error.problems()[0].what.find(what), std::string::npos) << error.what();
            EXPECT_EQ(error.problems()[0].accepted, accepted);
        }
    };
    const std::string title = "solid";
    expect(binary_stl(3), "counts 3 facets, but it has 184 bytes",
           "expected 234 bytes for this count");
    expect(title + binary_stl(3).substr(title.size()), "counts 3 facets, but it has 184 bytes",
           "expected 234 bytes for this count");
    expect(binary_stl(0xffffffff), "counts 4294967295 facets",
           "expected 214748364834 bytes for this count");
    expect(binary_stl(0), "counts 0 facets, but it has 184 bytes", "expected a mesh with faces");
    expect("no such thing", "too short", "expected a header of 84 bytes, where it has 13");
}

/// Reads, or is an Error that names the file.
void expect_answer(const std::filesystem::path &path) {
    try {
        read_mesh(path);
    } catch (const Error &error) {
        ASSERT_FALSE(error.problems().empty());
        EXPECT_TRUE(error.problems()[0].where.starts_with(path.string())) << error.what();
        EXPECT_NE(error.problems()[0].what, "");
    }
}

TEST_F(Interchange, DamagedFilesAreErrors) {
    for (const auto &[name, text] :
         {std::pair("a.fbx", test::kFbx), std::pair("a.dae", test::kCollada),
          std::pair("b.stl", binary_stl(2)), std::pair("a.stl", facets("front", 0))}) {
        for (std::size_t part = 1; part < 8; ++part)
            expect_answer(write(name, text.substr(0, part * text.size() / 8)));
        for (std::size_t at = 7; at < text.size(); at += text.size() / 40) {
            std::string damaged = text;
            damaged[at] = static_cast<char>(damaged[at] ^ 0x15);
            expect_answer(write(name, damaged));
        }
        EXPECT_THROW(read(name, ""), Error);
        EXPECT_THROW(read(name, "no such thing"), Error);
    }
    // An index that no vertex has
    for (const char *const number : {"-400", "4000", "-2147483648"})
        expect_answer(
            write("i.fbx", replaced(test::kFbx, "0,1,2,-4", std::string("0,1,2,") + number)));
    expect_answer(write("i.dae", replaced(test::kCollada, "<p>0 0", "<p>4000000 0")));
    // Of another kind than its name says
    EXPECT_THROW(read("a.dae", test::kFbx), Error);
    EXPECT_THROW(read("a.fbx", binary_stl(2)), Error);
}

TEST_F(Interchange, NoOtherFileIsOpened) {
    EXPECT_THROW(read_mesh("/nonexistent/a.fbx"), Error);
    EXPECT_THROW(read_mesh(write("a.fbx", test::kFbx).parent_path() / "b.fbx"), Error);
}

// Whether or not there is Assimp
TEST(InterchangeElsewhere, FormatsThatNobodyReadsSayWhatToExport) {
    for (const char *const name : {"a.usdz", "a.abc", "a.usd", "a.zprj"}) {
        const auto path = std::filesystem::temp_directory_path() / (std::string("tsuya_") + name);
        std::ofstream(path) << "x";
        try {
            read_mesh(path);
            ADD_FAILURE() << name;
        } catch (const Error &error) {
            EXPECT_NE(error.problems()[0].accepted.find("garment/docs/EXPORT.md"),
                      std::string::npos);
        }
        std::filesystem::remove(path);
    }
}

#ifndef TSUYA_HAS_ASSIMP
TEST(InterchangeElsewhere, ABuildWithoutAssimpNamesIt) {
    try {
        read_mesh("/proc/self/exe.fbx");
        FAIL();
    } catch (const Error &error) {
        EXPECT_NE(std::string(error.what()).find("TSUYA_ASSIMP"), std::string::npos);
    }
}
#endif

} // namespace
} // namespace tsuya::garment

#include "tsuya/garment/panels.h"

#include <gtest/gtest.h>

#include "garment/gltf_samples.h"
#include "garment/test_meshes.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/gltf.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

using Indices = std::vector<std::uint32_t>;
using Names = std::vector<std::string>;

/// Squares side by side, 0.1 m, each after the lines that name it.
std::string squares(const std::vector<std::string> &lines) {
    std::string text;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string x = std::to_string(0.2 * static_cast<double>(i)),
                          end = std::to_string(0.2 * static_cast<double>(i) + 0.1);
        text += "v " + x + " 0 0\nv " + end + " 0 0\nv " + end + " 0.1 0\nv " + x + " 0.1 0\n" +
                "vt 0 0\nvt 0.1 0\nvt 0.1 0.1\nvt 0 0.1\n" + lines[i] +
                "f -4/-4 -3/-3 -2/-2 -1/-1\n";
    }
    return text;
}

PolygonMesh pieces_and_fabrics() {
    return parse_obj(squares({"g FRONT\nusemtl satin\n", "usemtl crepe\n", "g BACK\nusemtl satin\n",
                              "g FRONT\nusemtl crepe\n"}),
                     "t.obj");
}

TEST(Panels, KeepGroupObjectAndMaterial) {
    const PolygonMesh mesh = pieces_and_fabrics();
    EXPECT_EQ(mesh.panel_name, (Names{"FRONT/satin", "FRONT/crepe", "BACK"}));
    EXPECT_EQ(mesh.face_panel, (Indices{0, 1, 2, 1}));
    EXPECT_EQ(mesh.panel_label[1], (PanelLabel{.group = "FRONT", .material = "crepe"}));
    EXPECT_EQ(mesh.panel_label[2], (PanelLabel{.group = "BACK", .material = "satin"}));
    const PolygonMesh all = parse_obj(squares({"o dress\ng a\nusemtl m\n", "g b\n"}), "t.obj");
    EXPECT_EQ(all.panel_name, (Names{"a", "b"}));
    EXPECT_EQ(all.panel_label[1], (PanelLabel{.object = "dress", .group = "b", .material = "m"}));
    // One name of groups and materials: nothing is called by both
    EXPECT_EQ(parse_obj(squares({"g a\nusemtl x\n", "g a\nusemtl y\n"}), "t.obj").panel_name,
              (Names{"x", "y"}));
}

TEST(Panels, AreNamedByAnyOfTheirNames) {
    const PolygonMesh mesh = pieces_and_fabrics();
    const auto named = [&](const char *pattern) { return panels_named(mesh, pattern, "t"); };
    EXPECT_EQ(named("satin"), (Indices{0, 2}));
    EXPECT_EQ(named("FRONT"), (Indices{0, 1}));
    EXPECT_EQ(named("FRONT/crepe"), (Indices{1}));
    EXPECT_EQ(named("*"), (Indices{0, 1, 2}));
    EXPECT_EQ(named("BA?K"), (Indices{2}));
    EXPECT_EQ(named("*R*/*e"), (Indices{1}));
    EXPECT_THROW(named("[cC]repe"), Error); // brackets are letters
    try {
        named("stain");
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].what, "no panel is named 'stain'");
        EXPECT_EQ(error.problems()[0].where, "t");
        EXPECT_NE(error.problems()[0].accepted.find("satin"), std::string::npos);
    }
    EXPECT_THROW(panels_named(test::panel(1, 1, 0.1), "a", "t"), Error);
    EXPECT_EQ(find_panels(mesh, "satin"), (Indices{0, 2}));
    EXPECT_EQ(find_panels(mesh, "stain"), Indices{});
}

TEST(Panels, BracketsAreLettersAndAQuestionMarkIsOneLetterOfAnyScript) {
    const PolygonMesh mesh = parse_obj(
        squares({"g Front[L]1\n", "g Front[L]2\n", "g \xec\x95\x9e\xed\x8c\x90\n"}), "t.obj");
    EXPECT_EQ(panels_named(mesh, "Front[L]*", "t"), (Indices{0, 1}));
    EXPECT_EQ(panels_named(mesh, "Front[L]2", "t"), (Indices{1}));
    EXPECT_EQ(panels_named(mesh, "\xec\x95\x9e?", "t"), (Indices{2}));
    EXPECT_EQ(panels_named(mesh, "??", "t"), (Indices{2}));
}

// Trying every place for every `*` would take 10^27 steps for the last.
TEST(Panels, PatternsOfManyStarsEnd) {
    const PolygonMesh mesh = parse_obj(
        squares({"g " + std::string(200, 'a') + "c\n", "g aabab\n", "g aabb\n"}), "t.obj");
    std::string stars;
    for (int i = 0; i < 20; ++i)
        stars += "*a";
    EXPECT_EQ(panels_named(mesh, "*ab", "t"), (Indices{1}));
    EXPECT_EQ(panels_named(mesh, "a*b*b", "t"), (Indices{1, 2}));
    EXPECT_EQ(panels_named(mesh, "a*?bb*", "t"), (Indices{2}));
    EXPECT_EQ(panels_named(mesh, stars + "*c**", "t"), (Indices{0}));
    EXPECT_THROW(panels_named(mesh, stars + "*b", "t"), Error);
}

TEST(Panels, ManyNames) {
    std::vector<std::string> lines;
    for (int i = 0; i < 70000; ++i)
        lines.push_back("g g" + std::to_string(i) + "\n");
    const PolygonMesh mesh = parse_obj(squares(lines), "t.obj");
    EXPECT_EQ(mesh.panel_name.size(), 70000u);
    EXPECT_EQ(mesh.face_panel.back(), 69999u);
    EXPECT_EQ(mesh.panel_name.back(), "g69999");
}

TEST(Panels, AreSplitByIsland) {
    PolygonMesh unnamed = test::both(test::panel(2, 2, 0.1), test::panel(2, 2, 0.1, {1, 0, 0}));
    unnamed.panel_name.clear();
    unnamed.face_panel.assign(8, 0);
    split_panels_by_island(unnamed);
    EXPECT_EQ(unnamed.panel_name, (Names{"island0", "island1"}));
    EXPECT_EQ(unnamed.face_panel, (Indices{0, 0, 0, 0, 1, 1, 1, 1}));

    PolygonMesh named = pieces_and_fabrics();
    split_panels_by_island(named);
    EXPECT_EQ(named.panel_name,
              (Names{"FRONT/satin", "FRONT/crepe/island1", "BACK", "FRONT/crepe/island3"}));
    EXPECT_EQ(panels_named(named, "island3", "t"), (Indices{3}));
    EXPECT_EQ(panels_named(named, "crepe", "t"), (Indices{1, 3}));
}

TEST(Panels, OfAGltfAreItsPrimitivesAndTheirHintsFollowIslands) {
    MeshFile file{.mesh = pieces_and_fabrics()};
    file.hints = {{.panel = "FRONT/crepe", .anisotropy_strength = 1}, {.panel = "BACK"}};
    split_panels_by_island(file);
    ASSERT_EQ(file.hints.size(), 3u);
    EXPECT_EQ(file.hints[0].panel, "FRONT/crepe/island1");
    EXPECT_EQ(file.hints[1].panel, "FRONT/crepe/island3");
    EXPECT_EQ(file.hints[1].anisotropy_strength, 1);
    EXPECT_EQ(file.hints[2].panel, "BACK");
}

TEST(Panels, AreReportedWithAreaAndBounds) {
    const Report report = check(pieces_and_fabrics());
    ASSERT_EQ(report.panel.size(), 3u);
    const PanelReport &crepe = report.panel[1];
    EXPECT_EQ(crepe.label.material, "crepe");
    EXPECT_EQ(crepe.faces, 2u);
    EXPECT_NEAR(crepe.area, 0.02, 1e-12);
    EXPECT_LT(glm::distance(crepe.lower, glm::dvec3(0.2, 0, 0)), 1e-6);
    EXPECT_LT(glm::distance(crepe.upper, glm::dvec3(0.7, 0.1, 0)), 1e-6);
}

// By the names that split_panels_by_island gives: what `check` lists can be named.
TEST(Panels, TheirIslandsAreReported) {
    const PolygonMesh mesh = pieces_and_fabrics();
    PolygonMesh parts = mesh;
    split_panels_by_island(parts);
    const Report report = check(mesh);
    ASSERT_EQ(report.island.size(), 2u);
    for (const PanelReport &island : report.island)
        EXPECT_EQ(find_panels(parts, island.name).size(), 1u) << island.name;
    EXPECT_EQ(report.island[0].name, "FRONT/crepe/island1");
    EXPECT_EQ(report.island[1].label.island, "island3");
    EXPECT_NEAR(report.island[1].area, 0.01, 1e-12);
    EXPECT_NEAR(report.island[1].warp.y, 1, 1e-12);
    EXPECT_EQ(report.panel[2].label.island, "island2"); // the only one of BACK
    EXPECT_EQ(report.panel[1].label.island, "");
    EXPECT_TRUE(check(test::panel(2, 2, 0.1)).island.empty());
    EXPECT_TRUE(load(mesh, {}, "t").report.island.empty());
}

// Buttons without UVs in a garment that has them.
TEST(Panels, OfPlainFabricsNeedNoUv) {
    PolygonMesh mesh = pieces_and_fabrics();
    for (std::uint32_t c = mesh.face_offset[2]; c < mesh.face_offset[3]; ++c)
        mesh.corner_uv[c] = -1;
    EXPECT_THROW(load(mesh, {}, "t"), Error);
    const LoadedGarment loaded = load(mesh, {.frames = {.plain = {"BACK"}}}, "t");
    EXPECT_EQ(loaded.report.repaired_area_share, 0);
    EXPECT_EQ(loaded.report.faces_without_uv, 0u);
    EXPECT_EQ(loaded.surface.panel_name, mesh.panel_name);
    EXPECT_THROW(load(mesh, {.frames = {.plain = {"FRONT/satin"}}}, "t"), Error);
}

} // namespace
} // namespace tsuya::garment

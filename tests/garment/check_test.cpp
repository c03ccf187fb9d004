#include <numbers>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/check.h"

namespace tsuya::garment {
namespace {

using test::both;
using test::keys;
using test::panel;

TEST(Check, MeasuresUvScaleUnitsAndMirroring) {
    PolygonMesh m = both(panel(4, 4, 0.1), panel(4, 4, 0.1, {1, 0, 0}));
    for (std::size_t t = 25; t < 50; ++t)
        m.uv[t].x = -m.uv[t].x;
    for (glm::dvec2 &t : m.uv)
        t.y *= 0.5;
    const Report report = check(m);
    EXPECT_NEAR(report.metres_per_uv_weft.p50, 1.0, 1e-12);
    EXPECT_NEAR(report.metres_per_uv_warp.p5, 2.0, 1e-12);
    EXPECT_EQ(report.mirrored_islands, 1u);
    EXPECT_EQ(report.mirrored_faces, 16u);
    EXPECT_NEAR(report.area, 2 * 0.16, 1e-12);
    EXPECT_TRUE(keys(report).contains("uneven_uv_scale"));
    EXPECT_FALSE(keys(report).contains("unusual_size"));
    PolygonMesh large = panel(4, 4, 30.0);
    EXPECT_TRUE(keys(check(large)).contains("unusual_size"));
    EXPECT_FALSE(keys(check(large, {}, {}, {}, true)).contains("unusual_size"));
}

TEST(Check, SaysWhatClothWillBeRefusedFor) {
    PolygonMesh mesh = panel(10, 10, 0.05);
    for (std::uint32_t c = 0; c < mesh.face_offset[30]; ++c)
        mesh.corner_uv[c] = -1;
    const Report report = check(mesh);
    EXPECT_TRUE(keys(report).contains("much_without_uv"));
    EXPECT_NEAR(report.area_without_uv, 30 * 0.05 * 0.05, 1e-12);
    EXPECT_FALSE(keys(check(panel(10, 10, 0.05))).contains("much_without_uv"));
}

TEST(Check, SaysThatUvsAreShattered) {
    PolygonMesh mesh = panel(20, 20, 0.02);
    mesh.uv.clear();
    for (std::size_t c = 0; c < mesh.corner_position.size(); ++c) { // a UV a corner, turned by face
        const glm::dvec3 p = mesh.position[mesh.corner_position[c]];
        mesh.uv.push_back(c / 4 % 2 == 0 ? glm::dvec2(p.x, p.y) : glm::dvec2(-p.y, p.x));
        mesh.corner_uv[c] = static_cast<std::int32_t>(c);
    }
    EXPECT_TRUE(keys(check(mesh)).contains("shattered_uv"));
    EXPECT_FALSE(keys(check(panel(20, 20, 0.02))).contains("shattered_uv"));
}

TEST(Check, SaysThatUvsAreNotInMetres) {
    PolygonMesh mesh = panel(4, 4, 0.1);
    for (glm::dvec2 &uv : mesh.uv)
        uv *= 0.1;
    const Report report = check(mesh);
    EXPECT_TRUE(keys(report).contains("uv_scale_measured"));
    EXPECT_NEAR(report.metres_per_uv, 10, 1e-9);
    EXPECT_FALSE(keys(check(mesh, {}, {}, 10.0)).contains("uv_scale_measured"));
    EXPECT_FALSE(keys(check(panel(4, 4, 0.1))).contains("uv_scale_measured"));
}

TEST(Check, MeasuresShearAndTheGrainOfEachPanel) {
    PolygonMesh m = both(panel(4, 4, 0.1), panel(4, 4, 0.1, {1, 0, 0}));
    for (glm::dvec3 &p : m.position)
        p.x += std::tan(0.3) * p.y; // the warp leans by 0.3
    for (std::size_t t = 25; t < 50; ++t)
        m.uv[t] = {m.uv[t].y, -m.uv[t].x}; // v runs along -x
    const Report report = check(m);
    EXPECT_NEAR(report.warp_weft_angle.p5, std::numbers::pi / 2 - 0.3, 1e-9);
    ASSERT_EQ(report.panel.size(), 2u);
    EXPECT_EQ(report.panel[1].name, "panel1");
    EXPECT_EQ(report.panel[0].faces, 16u);
    EXPECT_NEAR(report.panel[0].warp_to_vertical, 0.3, 1e-9);
    EXPECT_NEAR(report.panel[1].warp_to_vertical, std::numbers::pi / 2, 1e-9);
    EXPECT_LT(glm::distance(report.panel[1].warp, glm::dvec3(-1, 0, 0)), 1e-9);
    EXPECT_FALSE(keys(report).contains("strong_shear"));
    for (glm::dvec3 &p : m.position)
        p.x += p.y;
    EXPECT_TRUE(keys(check(m)).contains("strong_shear"));
}

TEST(Check, ADressInCentimetresOrMillimetresIsNamed) {
    const auto action = [](double height) {
        PolygonMesh m = panel(4, 4, 0.25 * height);
        for (const Finding &f : check(m).findings)
            if (f.key == "unusual_size")
                return f.action;
        return std::string();
    };
    EXPECT_EQ(action(1.3), "");
    EXPECT_NE(action(130).find("in cm"), std::string::npos);
    EXPECT_NE(action(1300).find("in mm"), std::string::npos);
    EXPECT_NE(action(13).find("in dm"), std::string::npos);
    for (const double height : {0.01, 13.0}) // a caller may have stated the unit
        EXPECT_EQ(action(height).find("read as metres"), std::string::npos) << action(height);
}

TEST(Check, EveryFindingSaysWhatIsDone) {
    PolygonMesh m = test::cube();
    m.position.emplace_back(5, 5, 5);
    m.add_face({0, 1, 1}, {-1, -1, -1}, 0);
    m.add_face({2, 3, 1, 0}, {-1, -1, -1, -1}, 0);
    m.add_face({0, 1, 8}, {-1, -1, -1}, 0);
    for (const Finding &f : check(m).findings)
        EXPECT_NE(f.action, "") << f.key;
}

} // namespace
} // namespace tsuya::garment

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/check.h"

namespace tsuya::garment {
namespace {

using test::both;
using test::keys;
using test::panel;

TEST(Manifold, CountsWhatItDrops) {
    PolygonMesh m = test::cube();
    m.position.emplace_back(5, 5, 5);
    m.add_face({0, 1, 1}, {-1, -1, -1}, 0);
    m.add_face({2, 3, 1, 0}, {-1, -1, -1, -1}, 0);
    const Prepared fixed = make_manifold(m);
    const ManifoldReport &report = fixed.report.file;
    EXPECT_EQ(fixed.positions.apply(m.position), fixed.mesh.position);
    EXPECT_EQ(fixed.mesh.face_count(), 6u);
    EXPECT_EQ(report.degenerate_faces, 1u);
    EXPECT_EQ(report.duplicate_faces, 1u);
    EXPECT_EQ(report.isolated_vertices, 1u);
    EXPECT_EQ(report.flipped_faces, 0u);
}

TEST(Manifold, TurnsTheMinorityOver) {
    PolygonMesh m = panel(5, 5, 0.1);
    for (const std::size_t f : {3u, 12u, 13u})
        std::reverse(m.corner_position.begin() + 4 * static_cast<std::ptrdiff_t>(f),
                     m.corner_position.begin() + 4 * static_cast<std::ptrdiff_t>(f) + 4);
    const Prepared p = prepare(m);
    EXPECT_EQ(p.report.file.flipped_faces, 3u);
    EXPECT_EQ(p.report.openings.size(), 1u);
    EXPECT_TRUE(keys(p.report).contains("flipped_faces"));
}

TEST(Manifold, SplitsBowTiesAndCutsMoebiusStrips) {
    PolygonMesh bow = both(panel(1, 1, 0.1), panel(1, 1, 0.1, {0.1, 0.1, 0}));
    bow.corner_position[4] = 3; // one vertex for both
    Report report = check(bow);
    EXPECT_EQ(report.file.non_manifold_vertices, 1u);
    EXPECT_EQ(report.parts, 2u);

    PolygonMesh strip;
    const int n = 12;
    for (int i = 0; i < n; ++i) {
        const double a = 2 * std::numbers::pi * i / n, b = 0.5 * a;
        const glm::dvec3 out(std::cos(a), std::sin(a), 0);
        for (const double w : {-0.3, 0.3})
            strip.position.push_back(out + w * (std::cos(b) * out + glm::dvec3(0, 0, std::sin(b))));
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i, b = a + 1, c = i + 1 == n ? 1 : a + 2,
                            d = i + 1 == n ? 0 : a + 3;
        strip.add_face({a, b, d, c}, {-1, -1, -1, -1}, 0);
    }
    report = check(strip);
    EXPECT_GT(report.file.unorientable_edges, 0u);
    EXPECT_TRUE(keys(report).contains("unorientable_edges"));
}

} // namespace
} // namespace tsuya::garment

#include <numbers>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {
namespace {

using test::both;
using test::keys;
using test::panel;
using test::triangulated;

TEST(Seams, PanelsThatLieEdgeToEdgeAreJoined) {
    const PolygonMesh two = both(panel(4, 3, 0.1), panel(4, 3, 0.1, {0.4002, 0, 0}));
    const Prepared p = prepare(two);
    EXPECT_EQ(p.report.parts_before, 2u);
    EXPECT_EQ(p.report.parts, 1u);
    EXPECT_EQ(p.report.loops_before, 2u);
    EXPECT_EQ(p.report.openings.size(), 1u);
    EXPECT_EQ(p.report.seams.joined, 4u);
    EXPECT_EQ(p.report.seams.splits, 0u);
    EXPECT_NEAR(p.report.seams.largest_gap, 0.0002, 1e-12);
    EXPECT_EQ(p.mesh.position.size(), two.position.size() - 4);
    EXPECT_EQ(p.report.uv_islands, 2u);
    EXPECT_NEAR(p.report.openings[0].length, 2 * (0.8002 + 0.3), 1e-9);
}

TEST(Seams, BeyondTheToleranceOrSwitchedOffNothingIsJoined) {
    const PolygonMesh two = both(panel(4, 3, 0.1), panel(4, 3, 0.1, {0.4002, 0, 0}));
    EXPECT_EQ(prepare(two, {.tolerance = 0.0001, .slit_width = 0}).report.parts, 2u);
    EXPECT_EQ(prepare(two, {.tolerance = -1}).report.parts, 2u);
    const PolygonMesh exact = both(panel(4, 3, 0.1), panel(4, 3, 0.1, {4 * 0.1, 0, 0}));
    EXPECT_EQ(prepare(exact, {.tolerance = 0}).report.parts, 1u);
}

TEST(Seams, TJunctionsAreSplitForQuadsAndTriangles) {
    // The neighbour has two edges where this one has one.
    const PolygonMesh coarse = panel(2, 2, 0.2), fine = panel(4, 4, 0.1, {0.4, 0, 0});
    const Prepared quads = prepare(both(coarse, fine));
    EXPECT_EQ(quads.report.seams.splits, 2u);
    EXPECT_EQ(quads.report.parts, 1u);
    EXPECT_EQ(quads.report.openings.size(), 1u);
    EXPECT_EQ(quads.report.openings[0].edges, 3u * 2 + 3 * 4);
    const Prepared triangles = prepare(triangulated(both(coarse, fine)));
    EXPECT_EQ(triangles.report.seams.splits, 2u);
    EXPECT_EQ(triangles.report.parts, 1u);
    for (std::size_t f = 0; f < triangles.mesh.face_count(); ++f)
        EXPECT_EQ(triangles.mesh.face_size(f), 3u);
    // The UV of the new corner lies on the edge, and stays apart from the neighbour's.
    bool found = false;
    for (std::size_t c = 0; c < quads.mesh.corner_position.size(); ++c)
        if (quads.mesh.position[quads.mesh.corner_position[c]] == glm::dvec3(0.4, 0.1, 0) &&
            quads.mesh.uv[static_cast<std::size_t>(quads.mesh.corner_uv[c])].x > 0.3) {
            found = true;
            EXPECT_NEAR(quads.mesh.uv[static_cast<std::size_t>(quads.mesh.corner_uv[c])].y, 0.1,
                        1e-12);
        }
    EXPECT_TRUE(found);
}

TEST(Seams, SlitsAreClosed) {
    // One vertex of the seam hangs off its neighbour by more than the tolerance.
    PolygonMesh two = triangulated(both(panel(4, 6, 0.01), panel(4, 6, 0.01, {0.04, 0, 0})));
    for (glm::dvec3 &p : two.position)
        if (glm::distance(p, glm::dvec3(0.04, 0.03, 0)) < 1e-9) {
            p.x += 0.001;
            break;
        }
    const Report open = check(two, {.slit_width = 0});
    EXPECT_EQ(open.openings.size(), 2u);
    const Report closed = check(two);
    EXPECT_EQ(closed.openings.size(), 1u);
    EXPECT_EQ(closed.seams.slits, 1u);
}

/// A tube about the y axis; `warp` edges around, `rows` upwards.
PolygonMesh tube(double radius, double height, int around, int rows) {
    return test::grid(around, rows, true, false, glm::dvec2(0.01), [&](int i, int j) {
        const double angle = 2 * std::numbers::pi * i / around;
        return glm::dvec3(radius * std::sin(angle), height * j / rows, radius * std::cos(angle));
    });
}

/// The other side out.
PolygonMesh turned(PolygonMesh mesh) {
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::reverse(mesh.corner_position.begin() + mesh.face_offset[f],
                     mesh.corner_position.begin() + mesh.face_offset[f + 1]);
        std::reverse(mesh.corner_uv.begin() + mesh.face_offset[f],
                     mesh.corner_uv.begin() + mesh.face_offset[f + 1]);
    }
    return mesh;
}

TEST(Seams, AHemOfFineEdgesIsNoSlit) {
    for (const double edge : {1.2e-3, 0.4e-3}) {
        const int around = static_cast<int>(std::lround(std::numbers::pi * 0.078 / edge));
        const PolygonMesh cuff = tube(0.039, 16 * edge, around, 16);
        const Prepared prepared = prepare(cuff);
        EXPECT_EQ(prepared.report.seams.slits, 0u) << edge;
        EXPECT_EQ(prepared.report.seams.unresolved, 0u);
        EXPECT_EQ(prepared.report.openings.size(), 2u);
        EXPECT_EQ(prepared.mesh.position, cuff.position);
    }
}

// A lining on its cloth, or 0.3 mm inside it, is not sewn to it.
TEST(Seams, LayersThatLieOnEachOtherAreNotSewn) {
    for (const double apart : {0.0, 0.3e-3})
        for (const int rows : {12, 7}) {
            const PolygonMesh outer = tube(0.26, 0.6, 24, 12);
            const PolygonMesh inner = tube(0.26 - apart, 0.6, 24, rows);
            for (const PolygonMesh &lining : {inner, turned(inner)}) {
                const Report report = check(both(outer, lining));
                EXPECT_EQ(report.parts, 2u);
                EXPECT_EQ(report.openings.size(), 4u);
                EXPECT_EQ(report.joined.duplicate_faces + report.joined.degenerate_faces, 0u);
                EXPECT_EQ(report.seams.layered, 96u);
                EXPECT_TRUE(keys(report).contains("two_layers"));
            }
        }
    // Negative control: one above the other they are sewn
    PolygonMesh above = tube(0.26, 0.6, 24, 12);
    for (glm::dvec3 &p : above.position)
        p.y += 0.6 + 0.3e-3;
    const Report sewn = check(both(tube(0.26, 0.6, 24, 12), above));
    EXPECT_EQ(sewn.parts, 1u);
    EXPECT_EQ(sewn.openings.size(), 2u);
    EXPECT_EQ(sewn.seams.layered, 0u);
}

// The panels of a tube as programs export them, apart from each other.
PolygonMesh unsewn_tube(double radius, int columns, int rows, int panels) {
    PolygonMesh whole;
    for (int k = 0; k < panels; ++k) {
        const int n = columns / panels;
        const PolygonMesh piece =
            test::grid(n, rows, false, false, glm::dvec2(0.05), [&](int i, int j) {
                const double angle = 2 * std::numbers::pi * (k * n + i) / columns;
                return glm::dvec3(radius * std::cos(angle), 0.6 * j / rows,
                                  radius * std::sin(angle));
            });
        whole = k == 0 ? piece : both(whole, piece);
    }
    return whole;
}

// The same of panels that are apart, of other edges than those of the cloth, in any order: each
// layer is sewn to itself alone.
TEST(Seams, LayersOfSeveralPanelsAreSewnEachToItself) {
    for (const double apart : {0.0, 0.3e-3, 0.45e-3})
        for (const int panels : {1, 2, 4})
            for (const int columns : {24, 40}) {
                const PolygonMesh shell = unsewn_tube(0.26, 24, 12, panels),
                                  lining = unsewn_tube(0.26 - apart, columns, 12, panels);
                for (const PolygonMesh &garment : {both(shell, lining), both(lining, shell)}) {
                    const Report report = check(garment);
                    EXPECT_EQ(report.parts, 2u) << apart << " " << panels << " " << columns;
                    EXPECT_EQ(report.openings.size(), 4u);
                    EXPECT_EQ(report.joined.flipped_faces + report.joined.non_manifold_edges, 0u);
                    EXPECT_EQ(report.seams.unresolved + report.seams.slits, 0u);
                    EXPECT_TRUE(keys(report).contains("two_layers"));
                }
            }
}

// Front and back of a flat garment meet at an angle that goes to 0 at the side seam: however fine
// the mesh is, they part from each other there.
TEST(Seams, AFlatTubeIsSewnAtItsSides) {
    for (const int columns : {20, 80}) {
        const auto half = [&](double side) {
            return test::grid(columns, columns, false, false, glm::dvec2(0.01), [&](int i, int j) {
                const double t = std::numbers::pi * i / columns;
                return glm::dvec3(-0.25 * std::cos(t), 0.6 * j / columns,
                                  side * 0.03 * std::pow(std::sin(t), 2));
            });
        };
        const Report report = check(both(half(1), turned(half(-1))));
        EXPECT_EQ(report.parts, 1u) << columns;
        EXPECT_EQ(report.openings.size(), 2u);
        EXPECT_EQ(report.seams.layered, 0u);
    }
}

/// All that was counted in the topology and along seams.
std::vector<std::size_t> counts(const Report &r) {
    std::vector<std::size_t> all{r.parts,           r.parts_before, r.loops_before,
                                 r.openings.size(), r.uv_islands,   r.concave_faces};
    for (const BoundaryLoop &loop : r.openings)
        all.push_back(loop.edges);
    for (const ManifoldReport &m : {r.file, r.joined})
        all.insert(all.end(), {m.degenerate_faces, m.duplicate_faces, m.non_manifold_edges,
                               m.non_manifold_vertices, m.detached_faces, m.isolated_vertices});
    const SeamReport &s = r.seams;
    all.insert(all.end(), {s.boundary_before, s.boundary_after, s.joined, s.splits, s.slits,
                           s.collapsed_edges, s.layered, s.unresolved});
    return all;
}

// In whatever unit a file is, and whatever was said about it: joined vertices, T-junctions, a slit,
// and a lining on the cloth.
TEST(Seams, ASmallerOrLargerMeshIsSewnAlike) {
    PolygonMesh two = triangulated(both(panel(4, 6, 0.1), panel(3, 5, 0.12, {0.4003, 0, 0})));
    two = both(two, both(panel(4, 6, 0.1, {2, 0, 0}), panel(4, 6, 0.1, {2, 0, 3e-4})));
    for (glm::dvec3 &p : two.position)
        if (glm::distance(p, glm::dvec3(0.4, 0.3, 0)) < 1e-9) {
            p.x -= 0.0015;
            break;
        }
    const Report as_it_is = check(two);
    EXPECT_EQ(as_it_is.parts, 3u);
    EXPECT_GT(as_it_is.seams.splits, 0u);
    EXPECT_GT(as_it_is.seams.slits, 0u);
    EXPECT_GT(as_it_is.seams.layered, 0u);
    for (const double scale : {1e-5, 1e-3, 1e-2, 1e2, 1e3}) {
        PolygonMesh scaled = two;
        for (glm::dvec3 &p : scaled.position)
            p *= scale;
        const Report report = check(scaled);
        EXPECT_EQ(counts(report), counts(as_it_is)) << scale;
        EXPECT_NEAR(report.seams.largest_gap, scale * as_it_is.seams.largest_gap, 1e-12 * scale);
        EXPECT_NEAR(report.seams.tolerance, scale * 0.5e-3, 1e-12 * scale);
        std::set<std::string> found = keys(report), expected = keys(as_it_is);
        for (const char *of_size : {"unusual_size", "uv_scale_measured"}) {
            found.erase(of_size);
            expected.erase(of_size);
        }
        EXPECT_EQ(found, expected) << scale;
    }
    PolygonMesh small = two;
    for (glm::dvec3 &p : small.position)
        p *= 1e3;
    EXPECT_EQ(check(small, {.tolerance = 0.5e-3}).parts, 4u); // as it was asked for
}

TEST(Seams, PleatsAreJoinedInPairsOfLayers) {
    // The lower panel runs forward, back and forward again along one edge of the upper.
    PolygonMesh pleated;
    const int x[] = {0, 1, 2, 3, 4, 5, 4, 3, 2, 1, 2, 3, 4, 5, 6};
    constexpr int kColumns = 15;
    for (int i = 0; i < kColumns; ++i) {
        pleated.position.emplace_back(0.1 * x[i], 0.0, 0.0);
        pleated.position.emplace_back(0.1 * x[i], -0.1, 0.05 * std::sin(10.0 * i));
        pleated.uv.emplace_back(0.1 * i, 0.1);
        pleated.uv.emplace_back(0.1 * i, 0.0);
    }
    for (std::uint32_t i = 0; i + 1 < kColumns; ++i) {
        const std::uint32_t a = 2 * i;
        const auto t = static_cast<std::int32_t>(a);
        pleated.add_face({a + 1, a + 3, a + 2, a}, {t + 1, t + 3, t + 2, t}, 0);
    }
    const Prepared p = prepare(both(panel(6, 2, 0.1), pleated));
    EXPECT_EQ(p.report.parts, 1u);
    EXPECT_EQ(p.report.joined.detached_faces, 0u);
    EXPECT_EQ(p.report.joined.non_manifold_edges, 4u);
    EXPECT_TRUE(keys(p.report).contains("layered_seams"));
    // Only the outline stays open, nothing along the seam.
    ASSERT_EQ(p.report.openings.size(), 1u);
    EXPECT_EQ(p.report.openings[0].edges, 6u + 2 * 2 + 2 + (kColumns - 1));
}

TEST(Seams, AFoldOneEdgeDeepStaysAFold) {
    // Two seam vertices that become one share the neighbour 5: two edges would become one.
    PolygonMesh fold;
    fold.position = {{0, 0, 0},   {0.1, 0, 0},    {0.1, -0.03, 0.03}, {0.1, 0, 1e-4},
                     {0.2, 0, 0}, {0.1, -0.1, 0}, {0, -0.1, 0},       {0.2, -0.1, 0}};
    for (const auto &f : {std::vector<std::uint32_t>{0, 6, 5},
                          {0, 5, 1},
                          {1, 5, 2},
                          {2, 5, 3},
                          {3, 5, 4},
                          {5, 7, 4}})
        fold.add_face(f, {-1, -1, -1}, 0);
    const Prepared p = prepare(both(triangulated(panel(2, 2, 0.1)), fold));
    EXPECT_EQ(p.report.parts, 1u);
    EXPECT_EQ(p.report.joined.detached_faces, 0u);
    EXPECT_EQ(p.report.openings.size(), 1u);
}

TEST(Seams, TheLimitSurfaceClosesBitExactly) {
    PolygonMesh two = both(panel(4, 3, 0.1), panel(4, 3, 0.1, {0.4002, 0, 0}));
    for (glm::dvec3 &p : two.position)
        p += 0.05 * glm::dvec3(std::sin(13.0 * p.y), std::sin(11.0 * p.y), std::sin(7.0 * p.y));
    for (const PolygonMesh &mesh : {two, triangulated(two)}) {
        const LimitMesh limit = subdivide(prepare(mesh).mesh, {.level = 2});
        std::size_t seam = 0;
        for (std::size_t v = 0; v < limit.place.size(); ++v) {
            const std::uint32_t p = limit.place[v];
            seam += p != v;
            EXPECT_EQ(limit.position[v], limit.position[p]);
            EXPECT_EQ(limit.normal[v], limit.normal[p]);
            EXPECT_EQ(limit.uv[v] == limit.uv[p], p == v);
        }
        EXPECT_EQ(seam, 3u * 4 + 1);
    }
}

TEST(Seams, AShortEdgeDoesNotHoldASlitOpen) {
    // Above the gap, three triangles join the panels; the middle one has an edge of 0.1 mm.
    PolygonMesh two = triangulated(both(panel(2, 3, 0.01), panel(2, 3, 0.01, {0.02, 0, 0})));
    for (std::size_t v = 12; v < two.position.size(); ++v)
        if (two.position[v].x < 0.0201 && two.position[v].y > 0.015)
            two.position[v].x += 0.0012;
    const std::uint32_t left = 10, a = 11, b = 12 + 9, right = 12 + 10, tip = 24;
    two.position[b] = two.position[a] + glm::dvec3(1e-4, 0, 0);
    two.position.emplace_back(0.02, 0.04, 0);
    for (const auto &f : {std::vector<std::uint32_t>{left, a, tip}, {a, b, tip}, {b, right, tip}})
        two.add_face(f, {-1, -1, -1}, 0);
    const Report report = check(two);
    EXPECT_EQ(report.openings.size(), 1u);
    EXPECT_EQ(report.seams.unresolved, 0u);
    EXPECT_GT(report.seams.collapsed_edges, 0u);
}

} // namespace
} // namespace tsuya::garment

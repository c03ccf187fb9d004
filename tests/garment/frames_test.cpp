#include <random>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/frames.h"
#include "tsuya/garment/garment.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::garment {
namespace {

Surface surface_of(const PolygonMesh &mesh, const FrameOptions &options = {}, int level = 1) {
    FrameReport report;
    Surface s = add_frames(subdivide(mesh, {.level = level}), options, report, "mesh");
    check_surface(s, "mesh");
    return s;
}

double angle_between(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

TEST(Frames, InterpolatedFramesStayOrthonormal) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> any(0, 1);
    for (const PolygonMesh &mesh : {test::Torus().mesh(8), test::panel(4, 4, 0.1)}) {
        const Surface s = surface_of(mesh, {.default_grain = 0.4});
        for (const glm::uvec3 &t : s.triangle)
            for (int k = 0; k < 8; ++k) {
                const float a = any(random), b = (1 - a) * any(random), c = 1 - a - b;
                const glm::vec3 n =
                    glm::normalize(a * s.normal[t.x] + b * s.normal[t.y] + c * s.normal[t.z]);
                const Frame f = make_frame(n, a * s.warp[t.x] + b * s.warp[t.y] + c * s.warp[t.z]);
                for (const float dot : {glm::dot(f.warp, f.normal), glm::dot(f.warp, f.weft),
                                        glm::dot(f.weft, f.normal)})
                    EXPECT_NEAR(dot, 0.0f, 1e-6f);
                for (const glm::vec3 &v : {f.warp, f.weft, f.normal})
                    EXPECT_NEAR(glm::length(v), 1.0f, 1e-6f);
            }
    }
}

TEST(Frames, PolesOfValenceTwoToAHundredAreFinite) {
    for (int valence = 2; valence <= 100; ++valence)
        for (const int corners : {3, 4}) {
            // A fan about a vertex: triangles, or quads with an outer vertex each.
            PolygonMesh m;
            m.position.emplace_back(0, 0, 0.1);
            m.uv.emplace_back(0, 0);
            const int ring = valence * (corners - 2);
            for (int i = 0; i < ring; ++i) {
                const double angle = 2 * std::numbers::pi * i / ring;
                m.position.emplace_back(std::cos(angle), std::sin(angle), 0);
                m.uv.emplace_back(std::cos(angle), std::sin(angle));
            }
            for (int i = 0; i < ring; i += corners - 2) {
                std::vector<std::uint32_t> v{0};
                for (int k = 0; k < corners - 1; ++k)
                    v.push_back(static_cast<std::uint32_t>(1 + (i + k) % ring));
                m.add_face(v, {v.begin(), v.end()}, 0);
            }
            if (corners == 3 && valence == 2)
                continue; // two triangles with the same corners: a duplicate face
            FrameReport report;
            // Finer ones take long.
            for (const int level : {1, valence < 8 || valence % 25 == 0 ? 3 : 0}) {
                const Surface s = add_frames(subdivide(m, {.level = level}),
                                             {.max_degenerate_area = 1.0}, report, "mesh");
                check_surface(s, "mesh"); // finite, unit
                EXPECT_FALSE(s.warp.empty());
            }
        }
}

TEST(Frames, FlatClothHasItsAxes) {
    const Surface s = surface_of(test::panel(3, 3, 0.1));
    for (std::size_t v = 0; v < s.position.size(); ++v) {
        EXPECT_LT(glm::distance(s.warp[v], glm::vec3(0, 1, 0)), 1e-6f);
        EXPECT_LT(glm::distance(s.weft[v], glm::vec3(1, 0, 0)), 1e-6f);
        EXPECT_LT(glm::distance(glm::dvec2(s.uv[v]), glm::dvec2(s.position[v])), 1e-6);
    }
}

TEST(Frames, GrainTurnsCounterClockwisePerPanel) {
    const PolygonMesh two = test::both(test::panel(2, 2, 0.1), test::panel(2, 2, 0.1, {1, 0, 0}));
    const Surface s = surface_of(two, {.grain = {{"panel1", 90 * kDegree}}, .metres_per_uv = 2.0});
    for (std::size_t v = 0; v < s.position.size(); ++v) {
        const bool turned = s.position[v].x > 0.5;
        EXPECT_LT(glm::distance(s.warp[v], turned ? glm::vec3(-1, 0, 0) : glm::vec3(0, 1, 0)),
                  1e-6f);
        EXPECT_LT(glm::distance(s.weft[v], turned ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)),
                  1e-6f);
        const glm::dvec2 t =
            2.0 * glm::dvec2(s.position[v].x - (turned ? 1.0 : 0.0), s.position[v].y);
        EXPECT_LT(glm::distance(glm::dvec2(s.uv[v]), turned ? glm::dvec2(t.y, -t.x) : t), 1e-6);
    }
    try {
        surface_of(two, {.grain = {{"panel7", 0.0}}});
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().at(0).where, "mesh: grain");
    }
}

TEST(Frames, ShearStaysInTheWeft) {
    PolygonMesh m = test::panel(3, 3, 0.1);
    for (glm::dvec3 &p : m.position)
        p.x += 0.5 * p.y; // the warp leans
    const Surface s = surface_of(m);
    EXPECT_NEAR(angle_between(glm::dvec3(s.warp[5]), glm::dvec3(s.weft[5])),
                std::numbers::pi / 2 - std::atan(0.5), 1e-6);
}

TEST(Frames, MirroredUvKeepsTheWarpAndARightHandedFrame) {
    PolygonMesh m = test::panel(3, 3, 0.1);
    for (glm::dvec2 &t : m.uv)
        t.x = -t.x;
    FrameReport report;
    const Surface s = add_frames(subdivide(m, {}), {}, report, "mesh");
    EXPECT_EQ(report.mirrored, s.position.size());
    for (std::size_t v = 0; v < s.position.size(); ++v) {
        EXPECT_LT(glm::distance(s.warp[v], glm::vec3(0, 1, 0)), 1e-6f);
        EXPECT_GT(glm::dot(glm::cross(s.weft[v], s.warp[v]), s.normal[v]), 0.99f);
    }
}

TEST(Frames, DegenerateUvIsFilledFromTheSamePanelOrRefused) {
    PolygonMesh m = test::panel(20, 20, 0.1);
    for (std::uint32_t c = m.face_offset[210]; c < m.face_offset[211]; ++c)
        m.corner_uv[c] = -1;
    FrameReport report;
    const LimitMesh limit = subdivide(m, {});
    const Surface s = add_frames(limit, {}, report, "mesh");
    EXPECT_GT(report.repaired, 0u);
    EXPECT_GT(report.repaired_area_share, 0.0);
    EXPECT_LT(report.repaired_area_share, 0.05);
    for (std::size_t v = 0; v < s.position.size(); ++v)
        EXPECT_LT(glm::distance(s.warp[v], glm::vec3(0, 1, 0)), 1e-5f);
    try {
        add_frames(limit, {.max_degenerate_area = 1e-6}, report, "dress.obj");
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems().at(0).where, "dress.obj");
    }
}

TEST(Frames, WithoutUvThereIsABodyOrAnInventedGrain) {
    const Surface body = surface_of(test::cube());
    EXPECT_TRUE(body.warp.empty());
    EXPECT_TRUE(body.weft.empty());
    PolygonMesh m = test::panel(3, 3, 0.1);
    std::fill(m.corner_uv.begin(), m.corner_uv.end(), -1);
    m.uv.clear();
    EXPECT_LT(glm::distance(surface_of(m, {.invented_grain = 0.0}).warp[3], glm::vec3(0, 1, 0)),
              1e-6f);
    EXPECT_LT(
        glm::distance(surface_of(m, {.invented_grain = 90 * kDegree}).warp[3], glm::vec3(-1, 0, 0)),
        1e-6f);
}

// The right half of the UVs is the mirror image of the left: across the fold neither side's
// derivatives may show.
TEST(Frames, AFoldedIslandIsCutWhereItTurnsOver) {
    PolygonMesh mesh = test::panel(8, 8, 0.1);
    for (std::size_t v = 0; v < mesh.uv.size(); ++v) {
        const glm::dvec3 p = mesh.position[v];
        mesh.uv[v] = {0.4 - std::abs(p.x - 0.4), p.y};
    }
    const Surface surface = load(mesh, {.subdivide = {.level = 2}}, "t").surface;
    for (const glm::vec3 &warp : surface.warp)
        EXPECT_LT(glm::distance(warp, glm::vec3(0, 1, 0)), 1e-4f);
    for (const glm::vec3 &weft : surface.weft)
        EXPECT_LT(glm::distance(weft, glm::vec3(1, 0, 0)), 1e-4f);
}

// A stated grain is for what has no UV, and leaves the rest as it is.
TEST(Frames, AStatedGrainFillsBadPartsAlone) {
    PolygonMesh mesh = test::panel(4, 4, 0.1);
    for (const std::size_t f : {0u, 1u, 4u, 5u}) // a quarter
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            mesh.corner_uv[c] = -1;
    for (glm::dvec2 &uv : mesh.uv)
        uv = {uv.y, -uv.x}; // the warp lies along +x
    EXPECT_THROW(load(mesh, {}, "t"), Error);
    const Surface surface = load(mesh, {.frames = {.invented_grain = 0.0}}, "t").surface;
    std::size_t filled = 0, kept = 0;
    for (std::size_t v = 0; v < surface.warp.size(); ++v) {
        const glm::dvec3 p = surface.position[v];
        if (p.x < 0.19 && p.y < 0.19) {
            EXPECT_LT(glm::distance(surface.warp[v], glm::vec3(0, 1, 0)), 1e-4f);
            ++filled;
        } else if (p.x > 0.21 || p.y > 0.21) {
            EXPECT_LT(glm::distance(glm::abs(surface.warp[v]), glm::vec3(1, 0, 0)), 1e-4f);
            ++kept;
        }
    }
    EXPECT_GT(filled, 0u);
    EXPECT_GT(kept, 0u);
}

/// A flat plate of triangles of all shapes, 0.9 m a side, UV in metres.
PolygonMesh irregular_plate(int side = 9, double left = 0.0) {
    const double step = 0.9 / side;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> jitter(-0.3 * step, 0.3 * step);
    PolygonMesh mesh;
    for (int j = 0; j <= side; ++j)
        for (int i = 0; i <= side; ++i) {
            const double x = step * i + (i > 0 && i < side ? jitter(random) : 0.0);
            const double y = step * j + (j > 0 && j < side ? jitter(random) : 0.0);
            mesh.position.emplace_back(left + x, y, 0.0);
            mesh.uv.emplace_back(x, y);
        }
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            const auto a = static_cast<std::uint32_t>(j * (side + 1) + i), b = a + 1,
                       c = a + side + 1, d = c + 1;
            const bool turned = random() % 2 == 0;
            using Triangles = std::array<std::array<std::uint32_t, 3>, 2>;
            for (const auto &[p, q, r] :
                 turned ? Triangles{{{a, b, c}, {b, d, c}}} : Triangles{{{a, b, d}, {a, d, c}}})
                mesh.add_face({p, q, r},
                              {static_cast<std::int32_t>(p), static_cast<std::int32_t>(q),
                               static_cast<std::int32_t>(r)},
                              0);
        }
    return mesh;
}

// Positions and UVs follow the same rules at a hem, so that one stays a linear map of the other.
TEST(Frames, AFlatPlateOfIrregularTrianglesHasOneDirectionUpToItsHem) {
    for (const int level : {0, 1, 3}) {
        const Surface surface =
            load(irregular_plate(), {.subdivide = {.level = level}}, "t").surface;
        float worst = 0;
        for (std::size_t v = 0; v < surface.warp.size(); ++v)
            worst = std::max({worst, glm::distance(surface.warp[v], glm::vec3(0, 1, 0)),
                              glm::distance(surface.weft[v], glm::vec3(1, 0, 0)),
                              glm::distance(surface.normal[v], glm::vec3(0, 0, 1))});
        EXPECT_LT(worst, 1e-4f) << level;
    }
}

// Panels may share their UVs, such as the halves of a pattern.
TEST(Frames, PanelsThatShareUvIndicesHaveTheirOwnDirections) {
    PolygonMesh two = test::both(irregular_plate(9), irregular_plate(9, 0.9));
    const std::size_t half = two.corner_uv.size() / 2;
    std::copy(two.corner_uv.begin(), two.corner_uv.begin() + static_cast<std::ptrdiff_t>(half),
              two.corner_uv.begin() + static_cast<std::ptrdiff_t>(half));
    const Surface surface = load(two, {.subdivide = {.level = 1}}, "t").surface;
    for (std::size_t v = 0; v < surface.warp.size(); ++v)
        EXPECT_LT(glm::distance(surface.warp[v], glm::vec3(0, 1, 0)), 5e-3f);
}

// Sewn to a plate of other triangles, whose vertices lie on its edges: each side's positions follow
// the rules of its UVs there, so no place is off.
TEST(Frames, ASeamOfOtherTrianglesHasOneDirection) {
    const PolygonMesh two = test::both(irregular_plate(9), irregular_plate(14, 0.9));
    for (const int level : {0, 1, 3}) {
        const Surface surface = load(two, {.subdivide = {.level = level}}, "t").surface;
        float worst = 0;
        for (std::size_t v = 0; v < surface.warp.size(); ++v)
            worst = std::max({worst, glm::distance(surface.warp[v], glm::vec3(0, 1, 0)),
                              glm::distance(surface.weft[v], glm::vec3(1, 0, 0))});
        EXPECT_LT(worst, 5e-3f) << level; // 0.0024, from vertices joined at their mean
    }
}

} // namespace
} // namespace tsuya::garment

#include <gtest/gtest.h>

#include <set>

#include "test_meshes.h"
#include "tsuya/garment/seams.h"
#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

TEST(Subdivide, SharesVerticesAlongEdges) {
    for (const int level : {0, 1, 2, 3}) {
        const std::size_t rate = std::size_t{1} << level;
        const LimitMesh open = subdivide(test::panel(3, 2, 0.1), {.level = level});
        EXPECT_EQ(open.position.size(), (3 * rate + 1) * (2 * rate + 1));
        EXPECT_EQ(open.triangle.size(), 3 * 2 * 2 * rate * rate);
        const LimitMesh closed = subdivide(test::cube(), {.level = level});
        EXPECT_EQ(closed.position.size(), 6 * rate * rate + 2);
        EXPECT_TRUE(closed.uv.empty());
    }
}

TEST(Subdivide, TrianglesCoverTheSurfaceOnce) {
    // On a flat panel, all triangles look up and their areas add up.
    const LimitMesh flat = subdivide(test::panel(3, 2, 0.1), {.level = 3});
    double area = 0.0;
    for (const glm::uvec3 &t : flat.triangle) {
        const glm::dvec3 a = flat.position[t.x];
        const double twice = glm::cross(flat.position[t.y] - a, flat.position[t.z] - a).z;
        EXPECT_GT(twice, 0.0);
        area += 0.5 * twice;
    }
    EXPECT_NEAR(area, 0.06, 1e-9);
    // On a closed surface, every edge has its counterpart.
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    const LimitMesh closed = subdivide(test::cut_cube(), {.level = 2});
    for (const glm::uvec3 &t : closed.triangle)
        for (int c = 0; c < 3; ++c)
            edges.emplace(t[c], t[(c + 1) % 3]);
    for (const auto &[a, b] : edges) {
        EXPECT_EQ(edges.count({a, b}), 1u);
        EXPECT_EQ(edges.count({b, a}), 1u);
    }
}

TEST(Subdivide, HemsKeepCornersAndStraightEdges) {
    const LimitMesh limit = subdivide(test::panel(3, 2, 0.1), {.level = 2});
    glm::dvec3 lower(1e9), upper(-1e9);
    for (std::size_t v = 0; v < limit.position.size(); ++v) {
        lower = glm::min(lower, limit.position[v]);
        upper = glm::max(upper, limit.position[v]);
        EXPECT_NEAR(limit.normal[v].z, 1.0f, 1e-6f);
        EXPECT_NEAR(limit.position[v].z, 0.0, 1e-12);
    }
    EXPECT_LT(glm::distance(lower, glm::dvec3(0.0)), 1e-12);
    EXPECT_LT(glm::distance(upper, glm::dvec3(0.3, 0.2, 0.0)), 1e-12);
}

TEST(Subdivide, PressedFoldsStaySharp) {
    // A sheet bent at a right angle along the middle, as one mesh with one UV: the surface lies in
    // two planes, but for what is rounded along the fold.
    const PolygonMesh sheet = test::grid(8, 4, false, false, glm::dvec2(0.1), [](int i, int j) {
        return glm::dvec3(i < 4 ? 0.1 * (i - 4) : 0.0, 0.1 * j, i < 4 ? 0.0 : 0.1 * (i - 4));
    });
    const auto rounded = [&](double crease, double angle) {
        const LimitMesh limit =
            subdivide(sheet, {.level = 4, .fold_crease = crease, .fold_angle = angle});
        double worst = 0.0;
        for (const glm::dvec3 &p : limit.position)
            worst = std::max(worst, std::min(std::abs(p.x), std::abs(p.z)));
        return worst;
    };
    EXPECT_GT(rounded(0.0, 1.0), 0.01);
    EXPECT_GT(rounded(9.0, 1.6), 0.01); // folded by less than that
    EXPECT_LT(rounded(9.0, 1.5), 1e-4); // of faces of 0.1
    EXPECT_LT(rounded(2.0, 1.5), 0.3 * rounded(0.0, 1.5));
    // Flat away from the fold, and smooth across it where it is not sharp.
    const LimitMesh limit = subdivide(sheet, {.level = 2, .fold_crease = 9.0});
    for (std::size_t v = 0; v < limit.position.size(); ++v) {
        const glm::dvec3 p = limit.position[v];
        if (p.x < -0.01) {
            EXPECT_GT(std::abs(limit.normal[v].z), 1.0f - 1e-5f);
        }
        if (p.z > 0.01) {
            EXPECT_GT(std::abs(limit.normal[v].x), 1.0f - 1e-5f);
        }
    }
}

TEST(Subdivide, IsTheSameEveryTime) {
    const PolygonMesh mesh = test::Torus().mesh(40);
    const LimitMesh a = subdivide(mesh, {.level = 2}), b = subdivide(mesh, {.level = 2});
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.triangle, b.triangle);
}

TEST(Subdivide, BadOptionsAndMeshesAreErrors) {
    const auto where = [](const PolygonMesh &mesh, const SubdivideOptions &options) {
        try {
            subdivide(mesh, options);
        } catch (const Error &error) {
            return error.problems().at(0).where;
        }
        return std::string("no error");
    };
    EXPECT_EQ(where(test::cube(), {.level = 9}), "subdivide.level");
    EXPECT_EQ(where(test::cube(), {.level = -1}), "subdivide.level");
    EXPECT_EQ(where(test::cube(), {.scheme = Scheme::loop}), "subdivide.scheme");
    EXPECT_EQ(where(test::cube(), {.seam_crease = -1.0}), "subdivide.seam_crease");
    EXPECT_EQ(where(test::cube(), {.fold_crease = 10.0}), "subdivide.fold_crease");
    EXPECT_EQ(where(test::cube(), {.fold_angle = 4.0}), "subdivide.fold_angle");
    PolygonMesh fan;
    fan.position.emplace_back(0, 0, 0);
    const std::uint32_t n = 600;
    for (std::uint32_t i = 0; i < n; ++i)
        fan.position.emplace_back(std::cos(0.01 * i), std::sin(0.01 * i), 0);
    for (std::uint32_t i = 1; i < n; ++i)
        fan.add_face({0, i, i + 1}, {-1, -1, -1}, 0);
    EXPECT_EQ(where(fan, {}), "mesh");
}

TEST(Subdivide, StopsWhenAsked) {
    const std::atomic<bool> stop = true;
    Progress progress;
    progress.stop = &stop;
    EXPECT_THROW(subdivide(test::cube(), {}, progress), Interrupted);
}

} // namespace
} // namespace tsuya::garment

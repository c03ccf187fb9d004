// Faces and vertices that subdivision would fold, or that would take it too long.

#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/garment.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// One face in the plane z = 0 with UV in metres.
PolygonMesh one_face(const std::vector<glm::dvec2> &outline) {
    PolygonMesh mesh;
    std::vector<std::uint32_t> v;
    std::vector<std::int32_t> t;
    for (const glm::dvec2 &p : outline) {
        v.push_back(static_cast<std::uint32_t>(mesh.position.size()));
        t.push_back(static_cast<std::int32_t>(mesh.uv.size()));
        mesh.position.emplace_back(p, 0.0);
        mesh.uv.push_back(p);
    }
    mesh.add_face(v, t, 0);
    return mesh;
}

double area_of(const std::vector<glm::dvec2> &outline) {
    double area = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i], b = outline[(i + 1) % outline.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return area;
}

/// The sum of the triangles' areas seen from +z, each by itself, and whether one is turned over.
struct Seen {
    double area = 0;
    bool turned = false;
};

Seen look_at(const Surface &surface) {
    Seen seen;
    for (const glm::uvec3 &t : surface.triangle) {
        const glm::dvec3 a = surface.position[t.x];
        const double z = 0.5 * glm::cross(surface.position[t.y] - a, surface.position[t.z] - a).z;
        seen.area += std::abs(z);
        seen.turned = seen.turned || z < -1e-12;
    }
    return seen;
}

void expect_flat(const std::vector<glm::dvec2> &outline, const char *name) {
    const PolygonMesh mesh = one_face(outline);
    for (int level = 0; level <= 4; ++level) {
        const LoadedGarment loaded = load(mesh, {.subdivide = {.level = level}}, name);
        const Seen seen = look_at(loaded.surface);
        EXPECT_NEAR(seen.area, area_of(outline), 1e-6) << name << " level " << level;
        EXPECT_FALSE(seen.turned) << name << " level " << level;
        for (std::size_t v = 0; v < loaded.surface.position.size(); ++v) {
            EXPECT_LT(glm::distance(glm::dvec2(loaded.surface.uv[v]),
                                    glm::dvec2(loaded.surface.position[v])),
                      1e-4)
                << name << " level " << level;
            EXPECT_LT(glm::distance(loaded.surface.warp[v], glm::vec3(0, 1, 0)), 1e-3f) << name;
        }
        EXPECT_EQ(loaded.report.concave_faces, 1u);
        EXPECT_NEAR(loaded.report.area, area_of(outline), 1e-12);
    }
}

const std::vector<glm::dvec2> kU{{0, 0},      {0.5, 0},    {0.5, 0.7},  {0.35, 0.7},
                                 {0.35, 0.2}, {0.15, 0.2}, {0.15, 0.7}, {0, 0.7}};

TEST(ConcaveFaces, KeepTheirAreaAtEveryLevel) {
    expect_flat(kU, "U");
    expect_flat({{0, 0}, {0.6, 0}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 0.6}, {0, 0.6}}, "L");
    expect_flat({{0, 0}, {0.3, 0.1}, {0.6, 0}, {0.3, 0.6}}, "arrow of four corners");
    // A corner in the middle of an edge.
    expect_flat(
        {{0, 0}, {0.3, 0}, {0.6, 0}, {0.6, 0.2}, {0.2, 0.2}, {0.2, 0.6}, {0, 0.6}, {0, 0.3}},
        "L with T-junctions");
}

TEST(ConcaveFaces, StarsOfAnyShapeAreNotFolded) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> radius(0.1, 0.5);
    for (int trial = 0; trial < 40; ++trial) {
        std::vector<glm::dvec2> outline;
        const int corners = 5 + trial % 20;
        for (int i = 0; i < corners; ++i) {
            const double a = 2 * std::numbers::pi * i / corners, r = radius(random);
            outline.emplace_back(r * std::cos(a), r * std::sin(a));
        }
        const LoadedGarment loaded = load(one_face(outline), {.subdivide = {.level = 3}}, "star");
        const Seen seen = look_at(loaded.surface);
        if (loaded.report.concave_faces == 1) {
            EXPECT_NEAR(seen.area, area_of(outline), 1e-6) << trial;
        }
        EXPECT_FALSE(seen.turned) << trial;
    }
}

TEST(ConcaveFaces, AreCutAmongOthersToo) {
    // A square of 2 x 2 quads one of which is an L, its notch filled by a fifth face.
    const PolygonMesh mesh = parse_obj(
        "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nv 0 2 0\nv 1 2 0\nv 2 2 0\n"
        "v 1.5 1 0\nv 1.5 1.5 0\nv 2 1.5 0\n"
        "f 1 2 5 4\nf 2 3 6 10 5\nf 4 5 8 7\nf 5 10 11 12 9 8\nf 10 6 12 11\n",
        "m");
    const LoadedGarment loaded = load(mesh, {.subdivide = {.level = 3}, .want_frames = false}, "m");
    EXPECT_EQ(loaded.report.concave_faces, 1u);
    EXPECT_EQ(loaded.report.file.non_manifold_edges, 0u);
    EXPECT_FALSE(look_at(loaded.surface).turned);
}

TEST(ConcaveFaces, ConvexOnesStayWhatTheyAre) {
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < 9; ++i)
        outline.emplace_back(0.5 * std::cos(i * 0.6981), 0.5 * std::sin(i * 0.6981));
    const Prepared round = prepare(one_face(outline));
    EXPECT_EQ(round.mesh.face_count(), 1u);
    EXPECT_TRUE(round.mesh.hem_corner.empty());
    // A quad that drape has bent by some degrees.
    const Prepared bent = prepare(one_face({{0, 0}, {0.1, 0}, {0.1, 0.1}, {0.052, 0.052}}));
    EXPECT_EQ(bent.mesh.face_count(), 1u);
}

TEST(ConcaveFaces, ThoseThatCrossThemselvesAreTold) {
    const Report report =
        check(one_face({{0, 0}, {1, 0}, {1, 1}, {0.2, -0.4}, {0.2, 1.2}, {0, 1}}));
    EXPECT_EQ(report.concave_faces, 0u);
    EXPECT_EQ(report.crossed_faces, 1u);
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(), [](const Finding &f) {
        return f.key == "crossed_faces" && f.severity == Severity::warning;
    }));
}

/// 80,000 triangles about vertex 0: with UVs of their own, apart, or all on one edge.
std::string fan(bool own_uvs, bool apart, bool one_edge) {
    constexpr int kFaces = 80000;
    std::string text = "v 0 0 0\nv 0 0 1\n";
    for (int i = 0; i < 2 * kFaces; ++i) {
        const double a = std::numbers::pi * i / kFaces;
        text += "v " + std::to_string(std::cos(a)) + " " + std::to_string(std::sin(a)) + " 0\n";
    }
    for (int i = 0; i < kFaces; ++i) {
        const int b = one_edge ? 2 : apart ? 2 * i + 3 : i + 3;
        const int c = apart ? 2 * i + 4 : i + 4, t = 3 * i + 1;
        const auto corner = [&](int v, int k) {
            return " " + std::to_string(v) + (own_uvs ? "/" + std::to_string(t + k) : "");
        };
        if (own_uvs)
            for (int k = 0; k < 3; ++k)
                text += "vt " + std::to_string(t + k) + " 0\n";
        text += "f" + corner(1, 0) + corner(b, 1) + corner(c, 2) + "\n";
    }
    return text;
}

TEST(LargeFans, AreRefusedBeforeStepsThatGrowWithTheSquare) {
    for (const std::string &text : {fan(false, false, false), fan(true, false, false),
                                    fan(false, true, false), fan(false, false, true)}) {
        const PolygonMesh mesh = parse_obj(text, "m"); // with a square of 80,000 this takes seconds
        try {
            check(mesh);
            FAIL();
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].what, "vertex 0 joins too many faces");
        }
    }
    std::vector<glm::dvec2> outline;
    for (int i = 0; i < 2000; ++i)
        outline.emplace_back(std::cos(i * std::numbers::pi / 1000),
                             std::sin(i * std::numbers::pi / 1000));
    EXPECT_THROW(check(one_face(outline)), Error);
}

TEST(LargeFans, UvsOfManyCornersAreSharedAsThoseOfFew) {
    PolygonMesh mesh;
    mesh.position.emplace_back(0.0);
    for (int i = 0; i <= 200; ++i)
        mesh.position.emplace_back(std::cos(0.03 * i), std::sin(0.03 * i), 0.0);
    for (std::uint32_t i = 0; i < 200; ++i) { // three UVs a face; those of vertex 0 have two values
        for (int k = 0; k < 3; ++k)
            mesh.uv.emplace_back(k == 0 ? static_cast<double>(i % 2) : i + k, 0.0);
        const auto t = static_cast<std::int32_t>(3 * i);
        mesh.add_face({0, i + 1, i + 2}, {t, t + 1, t + 2}, i / 100);
    }
    share_equal_uvs(mesh);
    for (std::uint32_t i = 0; i < 200; ++i) // first of its panel and value
        EXPECT_EQ(mesh.corner_uv[3 * i], static_cast<std::int32_t>(3 * (i / 100 * 100 + i % 2)));
}

} // namespace
} // namespace tsuya::garment

#include <gtest/gtest.h>

#include <map>

#include "test_meshes.h"
#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// A sheet of quads with a narrow fold: flat but near x = 0.5.
PolygonMesh folded_sheet() {
    return test::grid(20, 10, false, false, glm::dvec2(0.05), [](int i, int j) {
        const double x = 0.05 * i, s = (x - 0.5) / 0.06;
        return glm::dvec3(x, 0.05 * j, 0.08 * std::exp(-s * s));
    });
}

/// Edges by their places: how often each side is used.
std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides(const LimitMesh &m) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (const glm::uvec3 &t : m.triangle)
        for (int c = 0; c < 3; ++c)
            ++count[{m.place[t[c]], m.place[t[(c + 1) % 3]]}];
    return count;
}

TEST(Tessellation, StaysWithinTheTolerance) {
    for (const double tolerance : {1e-3, 1e-4}) {
        for (const PolygonMesh &mesh : {test::Torus().mesh(24), folded_sheet()}) {
            const TessellationError e = measure_tessellation(mesh, {.tolerance = tolerance});
            EXPECT_LE(e.position, tolerance);
            EXPECT_GT(e.position, 0.2 * tolerance); // no finer than needed
        }
    }
}

/// Quads, triangles and larger faces that meet in vertices of 3 to 8.
std::vector<PolygonMesh> irregular_meshes() {
    std::vector<PolygonMesh> meshes{test::cube(), test::cut_cube(),
                                    test::triangulated(test::cube()),
                                    test::triangulated(test::Torus().mesh(12))};
    for (const int n : {3, 5, 8})
        for (const bool triangles : {false, true}) {
            meshes.push_back(test::fan(n, false, triangles));
            for (glm::dvec3 &p : meshes.back().position)
                p.z += 0.3 * std::cos(2.0 * glm::length(p)) + 0.1 * p.x * p.y;
        }
    return meshes;
}

TEST(Tessellation, StaysWithinTheToleranceAboutIrregularVertices) {
    for (const PolygonMesh &mesh : irregular_meshes())
        for (const double tolerance : {3e-3, 3e-4}) {
            const TessellationError e = measure_tessellation(mesh, {.tolerance = tolerance});
            EXPECT_LE(e.position, tolerance);
            EXPECT_GT(e.position, 0.2 * tolerance);
        }
}

// The control of the above: distances by hand, of points of finer uniform tessellations from the
// nearest triangle, and a tolerance that the same triangles do not keep.
TEST(Tessellation, TrianglesAreNearToAllLimitPoints) {
    const double tolerance = 3e-3;
    for (const PolygonMesh &mesh : irregular_meshes()) {
        const LimitMesh coarse = subdivide(mesh, {.tolerance = tolerance});
        const LimitMesh fine = subdivide(mesh, {.level = 4});
        double worst = 0.0;
        for (std::size_t v = 0; v < fine.position.size(); v += 1 + fine.position.size() / 400) {
            double nearest = 1e9;
            for (const glm::uvec3 &t : coarse.triangle)
                nearest = std::min(nearest, test::distance_to_triangle(
                                                fine.position[v], coarse.position[t.x],
                                                coarse.position[t.y], coarse.position[t.z]));
            worst = std::max(worst, nearest);
        }
        EXPECT_LT(worst, 1.05 * tolerance);
        EXPECT_GT(worst, 0.1 * tolerance);
    }
}

TEST(Tessellation, AFoldCostsAQuarterOfTheUniformLevelOfTheSameError) {
    const PolygonMesh mesh = folded_sheet();
    const TessellationError fine = measure_tessellation(mesh, {.tolerance = 2e-4});
    int level = 0;
    TessellationError uniform = measure_tessellation(mesh, {.level = level});
    while (uniform.position > fine.position)
        uniform = measure_tessellation(mesh, {.level = ++level});
    EXPECT_LT(4 * fine.triangles, uniform.triangles);
}

TEST(Tessellation, TheErrorOfUniformLevelsFallsWithTheSquareOfTheSpacing) {
    const PolygonMesh mesh = test::Torus().mesh(24);
    const TessellationError coarse = measure_tessellation(mesh, {.level = 1}),
                            fine = measure_tessellation(mesh, {.level = 3});
    EXPECT_NEAR(coarse.position / fine.position, 16.0, 3.0);
    EXPECT_NEAR(coarse.position_rms / fine.position_rms, 16.0, 1.0);
    EXPECT_NEAR(coarse.normal_rms / fine.normal_rms, 16.0, 1.0);
    EXPECT_NEAR(coarse.warp_rms / fine.warp_rms, 16.0, 1.0);
}

TEST(Tessellation, RatesAgreeAlongEdges) {
    // Closed meshes: every side of every edge has its counterpart, once.
    for (const PolygonMesh &mesh :
         {test::Torus().mesh(12), test::triangulated(test::Torus().mesh(12)), test::cube()}) {
        const LimitMesh limit = subdivide(mesh, {.tolerance = 2e-3});
        const auto count = sides(limit);
        for (const auto &[side, n] : count) {
            EXPECT_EQ(n, 1);
            EXPECT_TRUE(count.contains({side.second, side.first}));
        }
    }
}

TEST(Tessellation, TrianglesOfMixedRatesCoverTheSheetOnce) {
    const LimitMesh limit = subdivide(folded_sheet(), {.tolerance = 1e-4});
    double area = 0.0;
    for (const glm::uvec3 &t : limit.triangle) {
        const glm::dvec3 a = limit.position[t.x];
        const double twice = glm::cross(limit.position[t.y] - a, limit.position[t.z] - a).z;
        EXPECT_GT(twice, -1e-12);
        area += 0.5 * twice;
    }
    EXPECT_NEAR(area, 0.5, 1e-9);
}

TEST(Tessellation, ACameraAsksForPixels) {
    const PolygonMesh mesh = folded_sheet();
    Camera camera{.eye = {0.5, 0.25, 2}, .target = {0.5, 0.25, 0}};
    const ViewTolerance view{.camera = camera, .pixels = 0.25};
    const TessellationError seen = measure_tessellation(mesh, {.view = view}, camera);
    EXPECT_LE(seen.pixels, 0.25);
    EXPECT_GT(seen.pixels, 0.05);
    // Farther away, coarser; looking elsewhere, as coarse as can be.
    ViewTolerance far = view;
    far.camera.eye.z = 32;
    EXPECT_LT(subdivide(mesh, {.view = far}).triangle.size(),
              0.6 * static_cast<double>(seen.triangles));
    ViewTolerance elsewhere = view;
    elsewhere.camera.target = {0.5, 0.25, 4};
    EXPECT_EQ(subdivide(mesh, {.view = elsewhere}).triangle.size(), 2 * mesh.face_count());
    // A light behind the sheet throws its shadow into the picture: fine again.
    elsewhere.lights = {{.centre = {0.5, 0.25, -5}}};
    EXPECT_GT(subdivide(mesh, {.view = elsewhere}).triangle.size(), 400u);
    elsewhere.lights = {{.centre = {0.5, 0.25, 5}}};
    EXPECT_EQ(subdivide(mesh, {.view = elsewhere}).triangle.size(), 2 * mesh.face_count());
    // But a light that large also shines from the other side.
    elsewhere.lights[0].radius = 9;
    EXPECT_GT(subdivide(mesh, {.view = elsewhere}).triangle.size(), 400u);
    elsewhere.lights.clear();
    elsewhere.light_from_everywhere = true;
    EXPECT_EQ(subdivide(mesh, {.view = elsewhere}).triangle.size(), seen.triangles);
}

TEST(Tessellation, EachKindOfCameraAsksForItsPixels) {
    const PolygonMesh mesh = folded_sheet();
    Camera parallel{
        .eye = {0.5, 0.25, 2}, .target = {0.5, 0.25, 0}, .height = 400, .orthographic_height = 1.2};
    ViewTolerance view{.camera = parallel, .pixels = 0.25};
    const TessellationError seen = measure_tessellation(mesh, {.view = view}, parallel);
    EXPECT_LE(seen.pixels, 0.25);
    EXPECT_GT(seen.pixels, 0.05);
    // No coarser from afar, and not seen beside the picture
    view.camera.eye.z = 50;
    EXPECT_EQ(subdivide(mesh, {.view = view}).triangle.size(), seen.triangles);
    const std::size_t control = 2 * mesh.face_count();
    view.camera.shift = {0, 2};
    EXPECT_EQ(subdivide(mesh, {.view = view}).triangle.size(), control);
    // A light throws the shadow of what is not seen into the picture
    view.lights = {{.centre = {0.5, -2, 3}}};
    view.farthest = 60;
    EXPECT_GT(subdivide(mesh, {.view = view}).triangle.size(), control);

    // A camera that looks beside the sheet sees it by a shift
    view = {.camera = {.eye = {0.5, 1.45, 2}, .target = {0.5, 1.45, 0}}, .pixels = 0.25};
    EXPECT_EQ(subdivide(mesh, {.view = view}).triangle.size(), control);
    view.camera.shift = {0, -1};
    const TessellationError low = measure_tessellation(mesh, {.view = view}, view.camera);
    EXPECT_LE(low.pixels, 0.25);
    EXPECT_GT(low.triangles, control);

    // The rim of a large aperture sees around the picture's edge
    view.camera.shift = {0, 0};
    view.camera.lens = Lens{.f_number = 0.05, .sensor_height = 0.2, .focus_distance = 6.0};
    EXPECT_GT(aperture_radius(view.camera), 1);
    EXPECT_GT(subdivide(mesh, {.view = view}).triangle.size(), control);
}

TEST(Tessellation, BadTolerancesAreErrors) {
    for (const double tolerance : {0.0, -1.0, std::nan("")})
        try {
            subdivide(test::cube(), {.tolerance = tolerance});
            FAIL();
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().at(0).where, "subdivide.tolerance");
        }
}

} // namespace
} // namespace tsuya::garment

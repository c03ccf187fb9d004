#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/frames.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/frame.h"

namespace tsuya::garment {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Surface surface_of(const PolygonMesh &mesh, const FrameOptions &options = {}, int level = 1) {
    FrameReport report;
    Surface s = add_frames(subdivide(mesh, {.level = level}), options, report, "mesh");
    check_surface(s, "mesh");
    return s;
}

double angle_between(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Errors {
    double position = 0.0, warp = 0.0;
};

/// Largest errors of the torus: distance to it, and warp angle where the grain is turned, so that
/// the warp mixes both derivatives.
Errors torus_errors(int n) {
    const test::Torus torus;
    const double grain = 30 * kDegree, c = std::cos(grain), d = std::sin(grain);
    const Surface s = surface_of(torus.mesh(n), {.default_grain = grain});
    Errors worst;
    for (std::size_t v = 0; v < s.position.size(); ++v) {
        const glm::dvec3 p = s.position[v];
        const double ring = std::hypot(p.x, p.y) - torus.big;
        worst.position = std::max(worst.position, std::abs(std::hypot(ring, p.z) - torus.tube));
        // The surface's UV is turned by the grain: turn it back.
        const glm::dvec2 t(c * s.uv[v].x - d * s.uv[v].y, d * s.uv[v].x + c * s.uv[v].y);
        const glm::dvec3 warp = c * torus.d_v(t.x, t.y) - d * torus.d_u(t.x, t.y);
        worst.warp = std::max(worst.warp, angle_between(warp, glm::dvec3(s.warp[v])));
    }
    return worst;
}

TEST(Frames, ErrorsOnATorusFallWithTheSquareOfTheSpacing) {
    const Errors coarse = torus_errors(48), fine = torus_errors(96);
    EXPECT_LT(fine.warp, 0.1 * kDegree);
    EXPECT_GT(coarse.warp / fine.warp, 3.0);
    EXPECT_LT(coarse.warp / fine.warp, 5.0);
    EXPECT_GT(coarse.position / fine.position, 3.0);
    EXPECT_LT(coarse.position / fine.position, 5.0);
}

double sphere_warp_error(int n) {
    // A band from 30 to 150 degrees, its UV = longitude, latitude; away from the two hems.
    const double step = 120 * kDegree / n;
    const int around = 3 * n;
    const auto at = [&](double u, double v) {
        return glm::dvec3(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v));
    };
    const PolygonMesh mesh = test::grid(
        around, n, true, false, glm::dvec2(step),
        [&](int i, int j) { return at(step * i, step * j - 60 * kDegree); },
        glm::dvec2(0, -60 * kDegree));
    const double grain = 20 * kDegree, c = std::cos(grain), d = std::sin(grain);
    const Surface s = surface_of(mesh, {.default_grain = grain});
    double worst = 0.0;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
        const double u = c * s.uv[i].x - d * s.uv[i].y, v = d * s.uv[i].x + c * s.uv[i].y;
        if (std::abs(v) > 50 * kDegree)
            continue;
        const glm::dvec3 d_u(-std::sin(u) * std::cos(v), std::cos(u) * std::cos(v), 0);
        const glm::dvec3 d_v(-std::cos(u) * std::sin(v), -std::sin(u) * std::sin(v), std::cos(v));
        worst = std::max(worst, angle_between(c * d_v - d * d_u, glm::dvec3(s.warp[i])));
        EXPECT_LT(angle_between(at(u, v), glm::dvec3(s.normal[i])), 0.5 * kDegree);
    }
    return worst;
}

TEST(Frames, ErrorsOnASphereFallWithTheSquareOfTheSpacing) {
    const double coarse = sphere_warp_error(24), fine = sphere_warp_error(48);
    EXPECT_LT(fine, 0.1 * kDegree);
    EXPECT_GT(coarse / fine, 3.0);
    EXPECT_LT(coarse / fine, 5.0);
}

/// A sheet over (u, v) in [-1, 1]^2 with known derivatives.
struct Sheet {
    glm::dvec3 (*at)(double u, double v);
    glm::dvec3 (*d_u)(double u, double v);
    glm::dvec3 (*d_v)(double u, double v);
};

/// Warp turns by up to 1 radian along the sheet.
const Sheet kTwisted{
    [](double u, double v) { return glm::dvec3(u, v * std::cos(u), v * std::sin(u)); },
    [](double u, double v) { return glm::dvec3(1, -v * std::sin(u), v * std::cos(u)); },
    [](double u, double) { return glm::dvec3(0, std::cos(u), std::sin(u)); }};
/// Warp leans over weft by an angle that grows with v, on a wave.
const Sheet kSheared{
    [](double u, double v) { return glm::dvec3(u + 0.3 * v * v, v, 0.2 * std::sin(2 * u)); },
    [](double u, double) { return glm::dvec3(1, 0, 0.4 * std::cos(2 * u)); },
    [](double, double v) { return glm::dvec3(0.6 * v, 1, 0); }};

struct SheetErrors {
    double position = 0, warp = 0, shear = 0;
};

/// Largest errors away from the hems. \param turn about (1, 1, 1), radians
SheetErrors sheet_errors(const Sheet &sheet, int n, double scale, double turn,
                         const glm::dvec3 &shift) {
    const glm::dmat3 rotation(glm::rotate(glm::dmat4(1.0), turn, glm::dvec3(1, 1, 1)));
    const auto moved = [&](const glm::dvec3 &p) { return scale * (rotation * p) + shift; };
    const double step = 2.0 / n;
    const Surface s = surface_of(test::grid(
        n, n, false, false, glm::dvec2(step),
        [&](int i, int j) { return moved(sheet.at(step * i - 1, step * j - 1)); }, glm::dvec2(-1)));
    SheetErrors worst;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
        const double u = s.uv[i].x, v = s.uv[i].y;
        if (std::abs(u) > 0.8 || std::abs(v) > 0.8)
            continue;
        const glm::dvec3 d_u = rotation * sheet.d_u(u, v), d_v = rotation * sheet.d_v(u, v);
        worst.position =
            std::max(worst.position, glm::distance(s.position[i], moved(sheet.at(u, v))) / scale);
        worst.warp = std::max(worst.warp, angle_between(d_v, glm::dvec3(s.warp[i])));
        worst.shear = std::max(
            worst.shear, std::abs(angle_between(d_u, d_v) -
                                  angle_between(glm::dvec3(s.weft[i]), glm::dvec3(s.warp[i]))));
    }
    return worst;
}

TEST(Frames, ErrorsOnTwistedAndShearedSheetsFallWithTheSquareOfTheSpacing) {
    for (const Sheet &sheet : {kTwisted, kSheared}) {
        const SheetErrors coarse = sheet_errors(sheet, 40, 1, 0, glm::dvec3(0)),
                          fine = sheet_errors(sheet, 80, 1, 0, glm::dvec3(0));
        EXPECT_LT(fine.warp, 0.1 * kDegree); // 40 quads a metre
        EXPECT_LT(fine.shear, 0.1 * kDegree);
        for (const auto &[a, b] : {std::pair(coarse.position, fine.position),
                                   {coarse.warp, fine.warp},
                                   {coarse.shear, fine.shear}})
            if (b > 1e-6) { // what is exact stays so, but for rounding of floats
                EXPECT_GT(a / b, 3.0);
                EXPECT_LT(a / b, 5.0);
            }
    }
}

TEST(Frames, ErrorsDoNotDependOnWhereASheetLiesNorOnItsSize) {
    for (const Sheet &sheet : {kTwisted, kSheared}) {
        const SheetErrors at_home = sheet_errors(sheet, 40, 1, 0, glm::dvec3(0));
        for (const double scale : {1e-3, 1.0, 1e5})
            for (const double shift : {0.0, 1e6}) {
                const SheetErrors away = sheet_errors(sheet, 40, scale, 0.7, glm::dvec3(shift));
                // Doubles hold a place 1e6 m away to 1e-10 m: of a sheet of a millimetre, 1e-7.
                const double rounding = 1e-6 + 1e-15 * shift / scale;
                EXPECT_NEAR(away.position, at_home.position, rounding);
                EXPECT_NEAR(away.warp, at_home.warp, 100 * rounding);
                EXPECT_NEAR(away.shear, at_home.shear, 100 * rounding);
            }
    }
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
    for (const int valence : {2, 3, 4, 5, 7, 16, 64, 100})
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
            for (const int level : {1, 3}) {
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

} // namespace
} // namespace tsuya::garment

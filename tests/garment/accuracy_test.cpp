// Places and yarn directions of the limit surface, against surfaces that are known exactly.

#include <functional>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "test_meshes.h"
#include "tsuya/garment/frames.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::garment {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
/// Turned, so that the warp mixes both derivatives.
constexpr double kGrain = 20 * kDegree;

/// A surface over a rectangle of UVs, which are not metres of it, with its derivatives.
struct Exact {
    const char *name;
    std::function<glm::dvec3(double u, double v)> at, d_u, d_v;
    glm::dvec2 from, to;
    glm::ivec2 cells;           ///< of the coarse control mesh: squares in UV
    double laplacian;           ///< largest length of d2P/du2 + d2P/dv2 where it counts
    bool wrap_u, wrap_v;        ///< closed, else with hems
    glm::dvec2 measured{100.0}; ///< largest |u| and |v| that count: away from the hems
};

Exact torus() {
    const test::Torus t;
    const auto call = [t](auto member) {
        return [t, member](double u, double v) { return (t.*member)(u, v); };
    };
    return {.name = "torus",
            .at = call(&test::Torus::at),
            .d_u = call(&test::Torus::d_u),
            .d_v = call(&test::Torus::d_v),
            .from = glm::dvec2(0),
            .to = glm::dvec2(kTurn),
            .cells = {32, 32},
            .laplacian = 1.8,
            .wrap_u = true,
            .wrap_v = true};
}

/// UV = longitude and latitude, from 60 degrees south to 60 degrees north.
Exact sphere() {
    return {
        .name = "sphere",
        .at = [](double u,
                 double v) { return glm::dvec3(cos(u) * cos(v), sin(u) * cos(v), sin(v)); },
        .d_u = [](double u, double v) { return glm::dvec3(-sin(u) * cos(v), cos(u) * cos(v), 0); },
        .d_v = [](double u,
                  double v) { return glm::dvec3(-cos(u) * sin(v), -sin(u) * sin(v), cos(v)); },
        .from = {0, -60 * kDegree},
        .to = {kTurn, 60 * kDegree},
        .cells = {36, 12},
        .laplacian = 2,
        .wrap_u = true,
        .wrap_v = false,
        .measured = {100, 50 * kDegree}};
}

/// The warp turns by up to 1 radian along the sheet.
Exact twisted_sheet() {
    return {.name = "twisted sheet",
            .at = [](double u, double v) { return glm::dvec3(u, v * cos(u), v * sin(u)); },
            .d_u = [](double u, double v) { return glm::dvec3(1, -v * sin(u), v * cos(u)); },
            .d_v = [](double u, double) { return glm::dvec3(0, cos(u), sin(u)); },
            .from = glm::dvec2(-1),
            .to = glm::dvec2(1),
            .cells = {20, 20},
            .laplacian = 0.8,
            .wrap_u = false,
            .wrap_v = false,
            .measured = glm::dvec2(0.8)};
}

/// The warp leans over the weft by an angle that grows with v, on a wave.
Exact sheared_sheet() {
    return {
        .name = "sheared sheet",
        .at = [](double u, double v) { return glm::dvec3(u + 0.3 * v * v, v, 0.2 * sin(2 * u)); },
        .d_u = [](double u, double) { return glm::dvec3(1, 0, 0.4 * cos(2 * u)); },
        .d_v = [](double, double v) { return glm::dvec3(0.6 * v, 1, 0); },
        .from = glm::dvec2(-1),
        .to = glm::dvec2(1),
        .cells = {20, 20},
        .laplacian = 1,
        .wrap_u = false,
        .wrap_v = false,
        .measured = glm::dvec2(0.8)};
}

/// Where a surface is put: turned about (1, 1, 1), then scaled, then moved.
struct Pose {
    double turn = 0, scale = 1;
    glm::dvec3 shift{0.0};
};

/// The largest errors: position in units of the surface before it is posed, angles in radians.
struct Errors {
    double position = 0, normal = 0, warp = 0, shear = 0;
};

double angle_between(const glm::dvec3 &a, const glm::dvec3 &b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void raise(double &worst, double error) {
    worst = std::isnan(error) ? error : std::max(error, worst);
}

/// \param density 1: the cells of `exact`, 2: half as wide
Errors measure(const Exact &exact, int density, const Pose &pose = {}) {
    const glm::dmat3 rotation(glm::rotate(glm::dmat4(1.0), pose.turn, glm::dvec3(1, 1, 1)));
    const auto posed = [&](const glm::dvec3 &p) {
        return pose.scale * (rotation * p) + pose.shift;
    };
    const glm::ivec2 n = density * exact.cells;
    const glm::dvec2 step = (exact.to - exact.from) / glm::dvec2(n);
    const PolygonMesh mesh = test::grid(
        n.x, n.y, exact.wrap_u, exact.wrap_v, step,
        [&](int i, int j) {
            const glm::dvec2 t = exact.from + step * glm::dvec2(i, j);
            return posed(exact.at(t.x, t.y));
        },
        exact.from);
    FrameReport report;
    const Surface s =
        add_frames(subdivide(mesh, {.level = 1}), {.default_grain = kGrain}, report, exact.name);
    check_surface(s, exact.name);

    const double c = std::cos(kGrain), d = std::sin(kGrain);
    Errors worst;
    for (std::size_t i = 0; i < s.position.size(); ++i) {
        // The surface's UV is turned by the grain: turn it back.
        const double u = c * s.uv[i].x - d * s.uv[i].y, v = d * s.uv[i].x + c * s.uv[i].y;
        if (std::abs(u) > exact.measured.x || std::abs(v) > exact.measured.y)
            continue;
        const glm::dvec3 d_u = rotation * exact.d_u(u, v), d_v = rotation * exact.d_v(u, v);
        const glm::dvec3 weft = c * d_u + d * d_v, warp = c * d_v - d * d_u;
        raise(worst.position, glm::distance(s.position[i], posed(exact.at(u, v))) / pose.scale);
        raise(worst.normal, angle_between(glm::cross(d_u, d_v), glm::dvec3(s.normal[i])));
        raise(worst.warp, angle_between(warp, glm::dvec3(s.warp[i])));
        raise(worst.shear, std::abs(angle_between(weft, warp) -
                                    angle_between(glm::dvec3(s.weft[i]), glm::dvec3(s.warp[i]))));
    }
    return worst;
}

const std::vector<Exact> &surfaces() {
    static const std::vector<Exact> all{torus(), sphere(), twisted_sheet(), sheared_sheet()};
    return all;
}

const std::vector<Pose> &poses() {
    static const std::vector<Pose> all = [] {
        std::vector<Pose> poses{{}};
        for (const double scale : {1e-3, 1.0, 1e5})
            for (const double shift : {0.0, 1e6})
                poses.push_back({0.7, scale, glm::dvec3(shift)});
        return poses;
    }();
    return all;
}

// The limit of a regular mesh is a uniform cubic B-spline. Of control points on a surface, h apart
// in UV, it lies beside the surface by h^2 / 6 of the second derivatives, and its first derivatives
// err by h^2 / 6 of the third, to lowest order.
TEST(Accuracy, ErrorsFallWithTheSquareOfTheSpacingWhereverASurfaceLies) {
    for (const Exact &exact : surfaces()) {
        const double h = (exact.to.x - exact.from.x) / (2 * exact.cells.x);
        Errors at_home;
        for (const Pose &pose : poses()) {
            SCOPED_TRACE(std::string(exact.name) + ", scale " + std::to_string(pose.scale) +
                         ", moved by " + std::to_string(pose.shift.x));
            const Errors coarse = measure(exact, 1, pose), fine = measure(exact, 2, pose);
            if (pose.turn == 0)
                at_home = coarse;
            // At 64 x 64, 72 x 24 and 40 x 40 quads
            EXPECT_LT(fine.normal, 0.1 * kDegree);
            EXPECT_LT(fine.warp, 0.1 * kDegree);
            EXPECT_LT(fine.shear, 0.1 * kDegree);
            EXPECT_NEAR(fine.position / (h * h / 6 * exact.laplacian), 1.0, 0.02);
            // Doubles hold a place 1e6 m away to 1e-10 m: of a surface of a millimetre, 1e-7.
            const double rounding = 1e-6 + 1e-15 * pose.shift.x / pose.scale;
            EXPECT_NEAR(coarse.position, at_home.position, rounding);
            for (double Errors::*const kind :
                 {&Errors::position, &Errors::normal, &Errors::warp, &Errors::shear}) {
                EXPECT_GT((coarse.*kind) / (fine.*kind), 3.8);
                EXPECT_LT((coarse.*kind) / (fine.*kind), 4.2);
                EXPECT_NEAR(coarse.*kind, at_home.*kind, 100 * rounding);
            }
        }
    }
}

} // namespace
} // namespace tsuya::garment

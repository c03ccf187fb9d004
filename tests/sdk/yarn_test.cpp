#include "tsuya/sdk/yarn.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "sdk/yarn_table.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

constexpr int kLevel = kYarnSlopes / 2;

// A warp-faced cloth: level floats that dip at 10 degrees, over a weft that lies level.
YarnLobes satin_lobes() {
    YarnLobes lobes{.f0 = 0.053, .roughness = 0.06, .loose = 0.05};
    lobes.surface[1][kLevel] = 0.8;
    lobes.surface[1][kLevel - 5] = lobes.surface[1][kLevel + 5] = 0.1;
    lobes.surface[0][kLevel] = 0.25;
    lobes.pit = {0.2, 0};
    return lobes;
}

TEST(FilamentBed, LetsLevelFilamentsSeeAllButEachOther) {
    const FilamentBed bed(0); // no flanks
    const auto at = [&](double light_deg, double viewer_deg) {
        const auto angle = [](double deg) {
            return bed_angle(static_cast<float>(std::sin(deg * kDegree)),
                             static_cast<float>(std::cos(deg * kDegree)));
        };
        const float light = angle(light_deg), viewer = angle(viewer_deg);
        return bed.at(FourFloats{light, viewer, light, viewer}).y;
    };
    EXPECT_NEAR(at(0, 0), 1, 1e-6);
    EXPECT_NEAR(at(60, -60), 1, 1e-6); // the top of a filament
    EXPECT_NEAR(at(0, 60), 1, 1e-6);
    // Straight back at 75 degrees: the next filament, touching or not, is in the way
    EXPECT_NEAR(at(75, 75), 0, 1e-6);
    EXPECT_GT(at(0, 80), 0.5);
    EXPECT_LT(at(0, 88), 0.1);
    EXPECT_EQ(at(20, 70), at(70, 20));
    EXPECT_NEAR(at(20, 70), at(-20, -70), 1e-6);
}

// Grazing light from one side misses the far flanks of yarns that stand side by side.
TEST(FilamentBed, HidesFlanksFromGrazingLight) {
    const FilamentBed flat(0), round(1);
    const float grazing = bed_angle(0.97f, 0.24f);
    const FourFloats opposite{grazing, -grazing, 0, 0};
    EXPECT_GT(flat.at(opposite).x, 0.99f);
    EXPECT_LT(round.at(opposite).x, 0.4f);
    EXPECT_GT(round.at(opposite).y, 0.6f);
}

TEST(YarnLobes, AreFoundAgainInTheViewsTheyMake) {
    const YarnLobes made = satin_lobes();
    const YarnBrdf brdf(made);
    const YarnLobes found = fit_yarn_lobes(Bard::fit(table_of(brdf, 0, 0), {}, "cloth"), made.f0);
    EXPECT_NEAR(found.roughness / made.roughness, 1, 0.15);
    for (const int axis : {0, 1}) {
        double surface = 0, expected = 0;
        for (int k = 0; k < kYarnSlopes; ++k) {
            surface += found.surface[axis][k];
            expected += made.surface[axis][k];
        }
        EXPECT_NEAR(surface / expected, 1, 0.1) << axis;
    }
    EXPECT_NEAR(found.pit[0], 0.2, 0.03); // a face with little weft: it lies deep
    EXPECT_EQ(found.pit[1], 0);
    // What was never shown to the fit
    const YarnBrdf again(found);
    const auto function = [&](const glm::dvec3 &l, const glm::dvec3 &v) {
        return static_cast<double>(again.evaluate(glm::vec3(l), glm::vec3(v)));
    };
    for (const double phi : {0.0, 45.0, 90.0})
        EXPECT_LT(measure_accuracy(table_of(brdf, 60, phi), function).mean.l2_cos.value(), 0.06)
            << phi;
}

// A cylinder turns light into a cone about its axis: for light along the warp, what the warp
// reflects keeps its part along the warp.
TEST(YarnBrdf, ReflectsIntoConesAboutTheYarns) {
    YarnLobes lobes{.f0 = 0.05, .roughness = 0.03};
    lobes.surface[1][kLevel] = 1; // warp only
    const YarnBrdf brdf(lobes);
    const glm::vec3 light(direction(50, 270));
    const double along = std::sin(50 * kDegree);
    for (double across = -0.5; across <= 0.5; across += 0.25) {
        const auto viewer = [&](double y) {
            return glm::vec3(across, y, std::sqrt(1 - across * across - y * y));
        };
        EXPECT_GT(brdf.evaluate(light, viewer(along)),
                  20 * brdf.evaluate(light, viewer(along - 0.3)))
            << across;
    }
}

// One more wall in the way for each system that lies in pits, none for the other.
TEST(YarnBrdf, LosesYarnsInPitsAtGrazing) {
    YarnLobes lobes = satin_lobes();
    lobes.loose = 0;
    lobes.surface[1].fill(0); // weft only
    lobes.pit = {0, 0};
    const YarnBrdf level(lobes);
    lobes.pit = {0.3, 0};
    const YarnBrdf deep(lobes);
    lobes.pit = {0, 0.3};
    const YarnBrdf other(lobes);
    const auto at = [](const YarnBrdf &brdf, double theta, double phi) {
        return brdf.evaluate(glm::vec3(direction(theta, phi)),
                             glm::vec3(direction(theta, phi + 180))) -
               brdf.lobes().even / 3.14159265;
    };
    // 1 - pit (tan + tan)
    EXPECT_NEAR(at(deep, 45, 0) / at(level, 45, 0), 0.4, 0.03);
    EXPECT_LT(at(deep, 60, 0) / at(level, 60, 0), 0.05);
    EXPECT_NEAR(at(deep, 45, 90) / at(level, 45, 90), 1, 0.01);
    EXPECT_NEAR(at(other, 45, 0) / at(level, 45, 0), 1, 1e-5);
}

TEST(YarnLobes, FindRoughnessesBetweenThoseThatAreTried) {
    for (const double roughness : {0.02, 0.065, 0.16, 0.26}) {
        YarnLobes made = satin_lobes();
        made.roughness = roughness;
        const Bard bard = Bard::fit(table_of(YarnBrdf(made), 0, 0), {}, "cloth");
        EXPECT_NEAR(fit_yarn_lobes(bard, made.f0).roughness / roughness, 1, 0.25) << roughness;
    }
}

// A cloth that reflects more than filaments can has a diffuse part.
TEST(YarnLobes, CoverNoMoreThanTheCloth) {
    for (const double brightness : {1.0, 8.0}) {
        ReflectanceTable table = table_of(YarnBrdf(satin_lobes()), 0, 0);
        for (ReflectanceRow &row : table.rows)
            row.brdf_per_sr *= brightness;
        const YarnLobes found = fit_yarn_lobes(Bard::fit(table, {}, "cloth"), 0.053);
        for (const auto &surface : found.surface)
            EXPECT_LE(std::accumulate(surface.begin(), surface.end(), 0.0), 0.5 * kPi + 1e-9);
        EXPECT_EQ(found.even > 0, brightness > 1);
        EXPECT_TRUE(found.even == 0 || found.loose == 0);
    }
}

// Yarns that dive between their neighbours are lost from the side, level ones are not.
TEST(YarnBrdf, LosesDivingYarnsToTheirNeighbours) {
    YarnLobes lobes{.f0 = 0.05, .roughness = 0.03};
    lobes.surface[1][kLevel] = 0.5;
    lobes.surface[1][kLevel - 8] = lobes.surface[1][kLevel + 8] = 0.3;
    const YarnBrdf flat(lobes);
    lobes.dive = 0.3;
    const YarnBrdf diving(lobes);
    const auto kept = [&](double slope_deg, double across) {
        const glm::dvec3 half =
            glm::normalize(glm::dvec3(across, std::tan(slope_deg * kDegree), 1));
        const glm::vec3 up(0, 0, 1), view(2 * half.z * half - glm::dvec3(up));
        return diving.evaluate(up, view) / flat.evaluate(up, view);
    };
    EXPECT_GT(kept(0, 0.6), 0.98f);
    EXPECT_GT(kept(16, 0.0), 0.95f);
    EXPECT_LT(kept(16, 0.6), 0.8f);
}

// The largest change of slope between neighbouring steps of a sweep, over the largest slope.
template <class F> double corner(const F &f) {
    constexpr double kStepDeg = 0.05;
    double sharpest = 0, steepest = 0;
    for (double at = -86; at < 86; at += kStepDeg) {
        const double below = f(at - kStepDeg), here = f(at), above = f(at + kStepDeg);
        sharpest = std::max(sharpest, std::abs(above - 2 * here + below));
        steepest = std::max(steepest, std::abs(above - here));
    }
    return sharpest / steepest;
}

TEST(YarnBrdf, HasNoCorners) {
    YarnLobes lobes = satin_lobes();
    lobes.dive = 0.3;
    const YarnBrdf brdf(lobes);
    for (const double theta : {0.0, 30.0, 60.0})
        for (const double phi : {0.0, 90.0}) {
            const glm::vec3 light(direction(theta, phi));
            const auto radiance = [&](double at) {
                const glm::vec3 view(direction(std::abs(at), at < 0 ? phi + 180 : phi));
                return static_cast<double>(brdf.evaluate(light, view)) * view.z;
            };
            EXPECT_LT(corner(radiance), 0.1) << theta << " " << phi;
            double peak = 0;
            for (double at = -86; at < 86; at += 1)
                peak = std::max(peak, radiance(at));
            EXPECT_GT(corner([&](double at) { return std::min(radiance(at), 0.5 * peak); }), 0.1)
                << theta << " " << phi; // control
        }
}

// A spline of cubes at the nodes has them, and between nodes is as near as its order lets it.
TEST(Spline, PassesThroughItsNodes) {
    constexpr int kNodes = 40;
    const auto function = [](double x) { return std::cos(0.3 * x); }; // even about 0
    std::vector<double> line(kNodes + 2);
    for (int i = 0; i < kNodes; ++i)
        line[static_cast<std::size_t>(i + 1)] = function(i);
    make_spline(line, SplineEnd::mirrored, SplineEnd::smooth);
    const auto at = [&](double x) {
        const SplinePlaces places(four(static_cast<float>(x)), four(kNodes - 1));
        const double *const c = &line[static_cast<std::size_t>(places.first[0])];
        return spline_between(c[0], c[1], c[2], static_cast<double>(places.from[0]));
    };
    for (int i = 0; i < kNodes; ++i)
        EXPECT_NEAR(at(i), function(i), 1e-6) << i;
    for (double x = 0; x <= kNodes - 1; x += 0.1)
        EXPECT_NEAR(at(x), function(x), 1.5e-3) << x;
    EXPECT_GT(std::abs(line[10] - function(9)), 3e-3); // control: the values are no coefficients
}

// The same in double, in the form of the documents.
TEST(YarnDepth, KeepsItsPrecisionAtGrazing) {
    YarnLobes lobes = satin_lobes();
    lobes.dive = 0;
    const YarnDepth depth(lobes);
    const auto size = [](double x) { return std::sqrt(x * x + 9e-4) - 0.03; };
    const auto plain = [&](const glm::dvec3 &l, const glm::dvec3 &v) {
        const double a = l.x / l.z, b = v.x / v.z;
        const double left = 1 - lobes.pit[0] * 0.5 * (size(a) + size(b) + size(a - b));
        const double root = std::sqrt(left * left + 2.5e-3);
        return (left > 0 ? left + root : 2.5e-3 / (root - left)) / (1 + std::sqrt(1 + 2.5e-3));
    };
    Random random(31);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto any = [&] {
            const double z = std::pow(10.0, -6.0 * random.number());
            const double phi = 6.2831853 * random.number(), s = std::sqrt(1 - z * z);
            return glm::vec3(s * std::cos(phi), s * std::sin(phi), z);
        };
        const glm::vec3 l = any(), v = any();
        const double seen = depth.in_sight(glm::normalize(l + v), YarnSpan(l, v)).x;
        worst = std::max(worst, std::abs(seen / plain(l, v) - 1));
    }
    EXPECT_LT(worst, 1e-4);
}

// What is rendered is what was fitted.
TEST(SlopeTable, HoldsTheLobes) {
    const auto error = [](double roughness, double of_table) {
        YarnLobes lobes = satin_lobes();
        lobes.roughness = of_table;
        const SlopeTable table(lobes, true, {});
        lobes.roughness = roughness;
        Random random(5);
        double squares = 0, count = 0;
        for (int i = 0; i < 4000; ++i) {
            const glm::vec3 u = random.point();
            const glm::dvec3 half = direction(std::acos(u.x) / kDegree, 360.0 * u.y);
            if (const double d = yarn_facets(lobes, 1, half); d > 1e-3) {
                squares += std::pow(table.at(glm::vec3(half)).y / d - 1, 2);
                ++count;
            }
        }
        return std::sqrt(squares / count);
    };
    for (const double roughness : {0.02, 0.03, 0.06, 0.13, 0.4})
        EXPECT_LT(error(roughness, roughness), 0.003) << roughness;
    EXPECT_GT(error(0.06, 0.061), 0.003); // control
}

TEST(YarnBrdf, RefusesReflectancesOutOfRange) {
    const Bard bard = bard_of(isotropic_cloth());
    for (const double f0 : {0.0, -0.1, 1.001, std::nan("")})
        EXPECT_THROW(YarnBrdf(bard, f0), Error);
    EXPECT_NO_THROW(YarnBrdf(YarnLobes{.f0 = 1}));
}

// Relative variance of the weights of what is drawn for a fixed direction.
double variance(const YarnBrdf &brdf, const glm::vec3 &fixed) {
    constexpr int kDraws = 20000;
    Random random(21);
    double sum = 0, squares = 0;
    for (int i = 0; i < kDraws; ++i)
        if (const auto s = brdf.sample(fixed, random.point())) {
            sum += s->weight;
            squares += double(s->weight) * s->weight;
        }
    return squares * kDraws / (sum * sum) - 1;
}

TEST(YarnBrdf, DrawsWhatIsSeen) {
    for (const Cloth &cloth : {satin_cloth(), leaning_cloth()}) {
        const YarnBrdf brdf(bard_of(cloth), cloth.f0);
        for (const double theta : {0.0, 20.0, 40.0, 60.0})
            for (const double phi : {0.0, 33.0, 90.0, 250.0})
                EXPECT_LT(variance(brdf, glm::vec3(direction(theta, phi))), 0.1)
                    << theta << " " << phi;
    }
}

} // namespace
} // namespace tsuya::test

#include "tsuya/sdk/detail/great_circle.h"

#include <algorithm>
#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/takeda.h"

namespace tsuya::test {
namespace {

constexpr int kDraws = 20000;

// [Takeda] Eq. 15 in double, as it is printed, with the direction turned in the plane of R and V.
glm::dvec3 plain_basic(const glm::dvec3 &light, const glm::dvec3 &view) {
    const double tilt = std::acos(light.z);
    if (tilt < 1e-12)
        return view;
    const glm::dvec3 away = -glm::normalize(glm::dvec3(light.x, light.y, 0));
    const glm::dvec3 across = view - glm::dot(view, away) * away;
    const double beta = std::atan2(glm::length(across), glm::dot(view, away));
    const double beta0 = beta <= kHalfPi - tilt
                             ? kHalfPi / (kHalfPi - tilt) * beta
                             : kHalfPi / (kHalfPi + tilt) * beta + kPi * tilt / (kHalfPi + tilt);
    return std::cos(beta0) * away + std::sin(beta0) * glm::normalize(across);
}

// Ratio of areas of a map of directions, by differences.
template <class Map> double area_ratio(const Map &map, const glm::dvec3 &d) {
    constexpr double kStep = 1e-6;
    const glm::dvec3 side = glm::normalize(
        glm::cross(std::abs(d.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), d));
    const glm::dvec3 other = glm::cross(d, side);
    const auto slope = [&](const glm::dvec3 &t) {
        return (map(glm::normalize(d + kStep * t)) - map(glm::normalize(d - kStep * t))) /
               (2 * kStep);
    };
    return glm::length(glm::cross(slope(side), slope(other)));
}

bool near_the_fold(const GreatCircle &c, const glm::dvec3 &light) {
    return std::abs(c.beta - (kHalfPi - std::acos(light.z))) < 1e-3;
}

TEST(GreatCircle, MeetsThePrintedEquationInDouble) {
    Random random(1);
    double worst = 0;
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        const glm::dvec3 expected = plain_basic(light, view);
        worst = std::max(worst, glm::length(glm::dvec3(to_basic(light, view).basic) - expected));
    }
    EXPECT_LT(worst, 2e-5);
}

TEST(GreatCircle, InverseReturnsToTheDirection) {
    Random random(2);
    double worst_view = 0;
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        const GreatCircle c = to_basic(light, view);
        const ViewOfBasic back = view_of_basic(light, c.basic);
        worst_view = std::max<double>(worst_view, glm::length(back.to_viewer - view));
        EXPECT_NEAR(back.slope, c.slope, near_the_fold(c, light) ? 100 : 1e-4 * c.slope);
        EXPECT_NEAR(back.sine_ratio, c.sine_ratio, 1e-3 * c.sine_ratio);
    }
    EXPECT_LT(worst_view, 2e-5);
}

TEST(GreatCircle, JacobianMeetsDifferences) {
    Random random(4);
    int tested = 0;
    for (int i = 0; i < kDraws / 4; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        const GreatCircle c = to_basic(light, view);
        if (light.z < 0.02f || view.z < 0.02f || near_the_fold(c, light))
            continue;
        ++tested;
        const double of_view =
            area_ratio([&](const glm::dvec3 &v) { return plain_basic(light, v); },
                       glm::normalize(glm::dvec3(view)));
        EXPECT_NEAR(c.sine_ratio * c.slope, of_view, 1e-3 * of_view);
    }
    EXPECT_GT(tested, kDraws / 5);
}

TEST(GreatCircle, LightFromAboveIsTheIdentity) {
    Random random(5);
    for (int i = 0; i < 1000; ++i) {
        const glm::vec3 view = random.direction();
        const GreatCircle c = to_basic({0, 0, 1}, view);
        EXPECT_LT(glm::length(c.basic - view), 1e-6f);
        EXPECT_NEAR(c.sine_ratio * c.slope, 1, 1e-5);
        EXPECT_LT(glm::length(view_of_basic({0, 0, 1}, view).to_viewer - view), 1e-6f);
    }
}

TEST(GreatCircle, EndsOfBetaHaveTheLimitsOfTheQuotient) {
    for (const double theta : {1.0, 30.0, 60.0, 89.0}) {
        const glm::vec3 light = direction(theta, 30);
        const double tilt = theta * kDegree;
        const glm::vec3 towards = -direction(90, 30), behind = direction(90, 30);
        EXPECT_NEAR(to_basic(light, towards).sine_ratio, kHalfPi / (kHalfPi - tilt),
                    1e-4 * kHalfPi / (kHalfPi - tilt));
        EXPECT_NEAR(to_basic(light, behind).sine_ratio, kHalfPi / (kHalfPi + tilt), 1e-4);
        // V = R stays where it is, and so does the other end
        EXPECT_LT(glm::length(to_basic(light, towards).basic - towards), 1e-5f);
        EXPECT_LT(glm::length(to_basic(light, behind).basic - behind), 1e-5f);
    }
}

TEST(GreatCircle, MirrorDirectionGoesToTheNormal) {
    for (const double theta : {5.0, 45.0, 80.0, 89.0}) {
        const GreatCircle c = to_basic(direction(theta, 200), direction(theta, 20));
        EXPECT_LT(glm::length(c.basic - glm::vec3(0, 0, 1)), 1e-4f) << theta;
    }
}

TEST(GreatCircle, OppositeViewAndLightStayFinite) {
    // L = -V exists only at the horizon
    const GreatCircle c = to_basic({1, 0, 0}, {-1, 0, 0});
    EXPECT_TRUE(std::isfinite(c.sine_ratio) && std::isfinite(c.slope));
    EXPECT_NEAR(glm::length(c.basic), 1, 1e-5);
    for (const double theta : {85.0, 89.0, 89.9, 89.99, 89.9999})
        for (const double phi : {0.0, 0.01, 90.0, 180.0}) {
            const glm::vec3 light = direction(theta, 180), view = direction(theta, phi);
            const GreatCircle g = to_basic(light, view);
            EXPECT_NEAR(glm::length(g.basic), 1, 1e-4) << theta << " " << phi;
            EXPECT_GE(g.basic.z, 0);
            EXPECT_TRUE(std::isfinite(g.sine_ratio) && std::isfinite(g.slope));
            EXPECT_NEAR(glm::length(view_of_basic(light, g.basic).to_viewer), 1, 1e-4);
        }
}

TEST(GreatCircle, ContinuousAcrossTheFold) {
    Random random(6);
    for (int i = 0; i < 1000; ++i) {
        const double theta = 85 * random.number(), psi = 180 * random.number();
        const auto view = [&](double beta_deg) {
            const double b = beta_deg * kDegree, p = psi * kDegree;
            return glm::vec3(std::cos(b), std::sin(b) * std::cos(p), std::sin(b) * std::sin(p));
        };
        const glm::vec3 light = direction(theta, 180);
        const glm::vec3 below = to_basic(light, view(90 - theta - 1e-3)).basic;
        const glm::vec3 above = to_basic(light, view(90 - theta + 1e-3)).basic;
        EXPECT_LT(glm::length(above - below), 2 * 2e-3 * kDegree * 90 / (90 - theta));
    }
}

// [Takeda] Eqs. 3-6 evaluated plainly.
double plain_factor(double f0, const glm::dvec3 &light, const glm::dvec3 &view) {
    const glm::dvec3 h = glm::normalize(light + view);
    const double facing = glm::dot(view, h);
    const double masking = std::min({1.0, 2 * h.z * view.z / facing, 2 * h.z * light.z / facing});
    const double m = 1 - glm::dot(light, h);
    return (f0 + (1 - f0) * m * m * m * m * m) * masking / (light.z * view.z);
}

// The tables of the model cancel in the ratio to its own value at V0 and N.
TEST(GreatCircle, RegularFormMeetsEquation14) {
    Cloth cloth = satin_cloth();
    for (YarnSystem &yarn : cloth.yarns)
        yarn.cover *= 0.2; // so that the energy limit stays out
    constexpr double kF0 = 0.06;
    const TakedaBrdf brdf(bard_of(cloth), kF0);
    ASSERT_LE(brdf.unlimited_albedo(), 1);
    const glm::dvec3 up(0, 0, 1);
    Random random(7);
    double worst = 0;
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        if (light.z < 0.02f || view.z < 0.02f)
            continue;
        const glm::dvec3 l = glm::normalize(glm::dvec3(light)),
                         v = glm::normalize(glm::dvec3(view));
        const glm::dvec3 basic = plain_basic(l, v);
        const double ratio = brdf.evaluate(light, view) / brdf.evaluate(up, glm::vec3(basic));
        const double expected = plain_factor(kF0, l, v) / plain_factor(kF0, up, basic);
        worst = std::max(worst, std::abs(ratio / expected - 1));
    }
    EXPECT_LT(worst, 3e-4);
}

// What tables and float cost against the surface itself.
TEST(GreatCircle, ModelMeetsTheSurfaceInDouble) {
    const Bard bard = bard_of(satin_cloth());
    constexpr double kF0 = 0.06;
    const TakedaBrdf brdf(bard, kF0);
    const glm::dvec3 up(0, 0, 1);
    Random random(8);
    double worst = 0;
    for (int i = 0; i < kDraws; ++i) {
        const glm::vec3 light = random.direction(), view = random.direction();
        // Below 60 degrees no albedo of this cloth is limited
        if (light.z < 0.5f || view.z < 0.02f)
            continue;
        const glm::dvec3 l = glm::normalize(glm::dvec3(light)),
                         v = glm::normalize(glm::dvec3(view));
        const glm::dvec3 basic = plain_basic(l, v);
        const double expected =
            plain_factor(kF0, l, v) / plain_factor(kF0, up, basic) * bard.at(basic);
        worst = std::max(worst, std::abs(brdf.evaluate(light, view) / expected - 1));
    }
    EXPECT_LT(worst, 0.01);
}

// The mean error over the hemisphere in per cent of the peak that the great-circle form has on a
// truth of GGX facets: a regression of the model as a whole.
TEST(GreatCircle, MeanErrorOnAGgxTruth) {
    const Cloth truth{.yarns = {{.alpha_weft = 0.45, .alpha_warp = 0.12}}, .f0 = 0.06};
    const Bard bard = Bard::fit(normal_table(truth, even_grid(3, 15)),
                                BardSmoothness{.noise_share = 1e-8}, "truth");
    const TakedaBrdf brdf(bard, truth.f0);
    struct Case {
        double theta, phi, per_cent;
    };
    for (const Case c : {Case{45, 0, 2.0}, {45, 45, 2.4}, {45, 90, 5.0}, {60, 90, 3.7}}) {
        const glm::dvec3 light = direction(c.theta, c.phi);
        double sum = 0, peak = 0;
        int count = 0;
        for (double theta = 0; theta < 88; theta += 2)
            for (double phi = 0; phi < 360; phi += 5) {
                const glm::dvec3 view = direction(theta, phi);
                const double expected = reflectance(truth, light, view);
                sum += std::abs(brdf.evaluate(light, view) - expected);
                peak = std::max(peak, expected);
                ++count;
            }
        const double per_cent = 100 * sum / count / peak;
        std::cout << "light (" << c.theta << ", " << c.phi << ") mean error " << per_cent
                  << " % of the peak\n";
        EXPECT_NEAR(per_cent, c.per_cent, 0.25 * c.per_cent + 0.3);
    }
}

} // namespace
} // namespace tsuya::test

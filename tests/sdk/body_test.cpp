#include "tsuya/sdk/body.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/lustre.h"

namespace tsuya::test {
namespace {

constexpr int kLevel = kYarnSlopes / 2;
constexpr int kEvaluations = 40000;

// A warp-faced cloth whose weft lies level too.
YarnLobes satin_lobes() {
    YarnLobes lobes{.f0 = 0.053, .roughness = 0.06};
    lobes.surface[1][kLevel] = 0.8;
    lobes.surface[1][kLevel - 5] = lobes.surface[1][kLevel + 5] = 0.1;
    lobes.surface[0][kLevel] = 0.25;
    return lobes;
}

YarnLobes warp_lobes() {
    YarnLobes lobes = satin_lobes();
    lobes.surface[0].fill(0);
    return lobes;
}

const YarnBrdf &surface() {
    static const YarnBrdf made(satin_lobes());
    return made;
}
const BodyBrdf &body() {
    static const BodyBrdf made(surface());
    return made;
}

double albedo(const auto &brdf, const glm::vec3 &view) {
    return integrate([&](const glm::vec3 &l) { return double(brdf.evaluate_cos(l, view)); },
                     kEvaluations);
}

std::vector<glm::vec3> views() {
    std::vector<glm::vec3> all{{0, 0, 1}};
    for (const double theta : {20.0, 45.0, 65.0, 80.0, 86.0})
        for (const double phi : {0.0, 40.0, 90.0})
            all.emplace_back(direction(theta, phi));
    return all;
}

// Light along the warp leaves on the cone about it: bright opposite, dark at the same height aside.
TEST(Body, FollowsTheYarns) {
    const BodyBrdf warp{YarnBrdf(warp_lobes())};
    const glm::vec3 light(direction(40, 90)), back(direction(10, 90));
    EXPECT_GT(warp.evaluate(light, glm::vec3(direction(40, 270))), 0.5f);
    EXPECT_LT(warp.evaluate(light, back), 0.1f);
    // Light across the warp spreads over the plane across
    const glm::vec3 across(direction(40, 0));
    for (const double theta : {10.0, 40.0, 70.0})
        EXPECT_GT(warp.evaluate(across, glm::vec3(direction(theta, 180))), 0.4f);
    EXPECT_LT(warp.evaluate(across, glm::vec3(direction(60, 90))), 0.1f);
}

// The part of the weft is what a cloth with no other filament has, up to the common scale.
TEST(Body, TellsTheSystemsApart) {
    const BodyBrdf warp{YarnBrdf(warp_lobes())};
    for (const glm::vec3 &view : views()) {
        const glm::vec3 light(direction(33, 200));
        EXPECT_LE(warp.weigh(light, view).weft, 1e-5f);
        EXPECT_GT(body().weigh(light, view).weft, 0);
    }
}

TEST(Body, ReflectsWithTheSurfaceAllThatArrives) {
    double worst = 0;
    for (const glm::vec3 &view : views()) {
        const double all = albedo(surface(), view) + albedo(body(), view);
        EXPECT_NEAR(all, 0.99, 0.015) << view.z;
        worst = std::max(worst, all);
    }
    EXPECT_LE(worst, 1.003);
    // Control: a body that does not know of the surface reflects what the surface had
    const BodyBrdf alone(satin_lobes(), [](const glm::vec3 &) { return 0.0f; });
    const glm::vec3 low(direction(86, 0));
    EXPECT_GT(albedo(surface(), low) + albedo(alone, low), 1.05);
}

TEST(Delustre, GrowsWithPalenessAndDelustrant) {
    for (const double reflectance : {0.0, 0.05, 0.3, 0.6, 1.0}) {
        const double bright = delustre_of(Lustre::bright, reflectance);
        EXPECT_GE(bright, 0);
        EXPECT_LT(bright, delustre_of(Lustre::semi_dull, reflectance));
        EXPECT_LT(delustre_of(Lustre::semi_dull, reflectance),
                  delustre_of(Lustre::dull, reflectance));
        EXPECT_LE(delustre_of(Lustre::dull, reflectance), 1);
    }
    for (const Lustre lustre : {Lustre::bright, Lustre::semi_dull, Lustre::dull})
        EXPECT_LT(delustre_of(lustre, 0.05), delustre_of(lustre, 0.8));
}

} // namespace
} // namespace tsuya::test

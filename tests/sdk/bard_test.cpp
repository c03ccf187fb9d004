#include "tsuya/sdk/bard.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/feature_points.h"

namespace tsuya::test {
namespace {

ReflectanceRow view(double theta_deg, double phi_deg, double value, double sigma = 0) {
    return {.theta_r = theta_deg * kDegree,
            .phi_r = phi_deg * kDegree,
            .brdf_per_sr = value,
            .sigma_per_sr = sigma};
}

Bard fit(const ReflectanceTable &table) { return Bard::fit(table, "table.csv"); }

TEST(Bard, MeetsExactViews) {
    const Bard bard = fit(normal_table(satin_cloth(), even_grid(6, 15)));
    EXPECT_LT(bard.residual(), 1e-3);
    for (const BardView &v : bard.views()) {
        const glm::dvec3 d = direction(v.theta / kDegree, v.phi / kDegree);
        EXPECT_NEAR(bard.at(d), v.brdf_per_sr, 0.005 * v.brdf_per_sr);
        EXPECT_NEAR(bard.at(d), v.fitted_per_sr, 1e-9 * v.fitted_per_sr);
    }
}

TEST(Bard, ReproducesASmoothFunctionBetweenTheViews) {
    const Cloth cloth = satin_cloth();
    const Bard bard = fit(normal_table(cloth, even_grid(5, 10)));
    double worst = 0;
    for (double theta = 0; theta < 80; theta += 1.7)
        for (double phi = 0; phi < 360; phi += 7.3) {
            const glm::dvec3 d = direction(theta, phi);
            const double expected = reflectance(cloth, {0, 0, 1}, d);
            worst = std::max(worst, std::abs(bard.at(d) - expected) / expected);
        }
    EXPECT_LT(worst, 0.02);
}

TEST(Bard, PositiveBetweenNoisyAndNarrowViews) {
    ReflectanceTable table = normal_table(narrow_cloth(), even_grid(5, 15));
    Random random(31);
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr *= random.number() < 0.2f ? 0 : 0.5 + random.number();
    const Bard bard = fit(table);
    for (int i = 0; i < 20000; ++i) {
        const double value = bard.at(random.direction());
        ASSERT_TRUE(std::isfinite(value) && value > 0);
    }
}

TEST(Bard, DoesNotOvershootANarrowPeak) {
    const Cloth cloth = narrow_cloth();
    const ReflectanceTable table = normal_table(cloth, even_grid(3, 15));
    const Bard bard = fit(table);
    double highest = 0;
    Random random(32);
    for (int i = 0; i < 20000; ++i)
        highest = std::max(highest, bard.at(random.direction()));
    for (double theta = 0; theta < 10; theta += 0.05)
        highest = std::max(highest, bard.at(direction(theta, 3 * theta)));
    EXPECT_LT(highest, 1.05 * bard.peak());
}

TEST(Bard, SymmetriesHoldToDoublePrecision) {
    Random random(33);
    const Bard orthotropic = bard_of(satin_cloth()), half_turn = bard_of(twisted_cloth());
    const Bard none = bard_of(leaning_cloth());
    double mirrored_change = 0, turned_change = 0;
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 d = random.direction();
        const glm::dvec3 turned(-d.x, -d.y, d.z), mirrored(d.x, -d.y, d.z);
        EXPECT_NEAR(orthotropic.at(d), orthotropic.at(mirrored), 1e-12 * orthotropic.at(d));
        EXPECT_NEAR(orthotropic.at(d), orthotropic.at(turned), 1e-12 * orthotropic.at(d));
        EXPECT_NEAR(half_turn.at(d), half_turn.at(turned), 1e-12 * half_turn.at(d));
        mirrored_change = std::max(mirrored_change, half_turn.at(mirrored) / half_turn.at(d));
        turned_change = std::max(turned_change, none.at(turned) / none.at(d));
    }
    // What is not declared is not enforced
    EXPECT_GT(mirrored_change, 1.5);
    EXPECT_GT(turned_change, 1.5);
}

// Slopes from both sides, in the plane of the disk.
void expect_same_slope(const Bard &bard, const glm::dvec3 &at, const glm::dvec3 &across) {
    constexpr double kStep = 1e-5;
    const auto value = [&](double s) { return std::log(bard.at(glm::normalize(at + s * across))); };
    const double before = (value(0) - value(-kStep)) / kStep;
    const double after = (value(kStep) - value(0)) / kStep;
    EXPECT_NEAR(before, after, 0.02) << at.x << " " << at.y << " " << at.z;
}

TEST(Bard, SmoothAcrossMirrorPlanesAndPole) {
    const Bard bard = bard_of(satin_cloth());
    for (double theta = 2; theta < 89; theta += 3) {
        expect_same_slope(bard, direction(theta, 0), {0, 1, 0});
        expect_same_slope(bard, direction(theta, 90), {1, 0, 0});
    }
    for (double phi = 0; phi < 180; phi += 13)
        expect_same_slope(bard, {0, 0, 1}, direction(90, phi));
    for (const Cloth &cloth : {twisted_cloth(), leaning_cloth()})
        for (double phi = 0; phi < 360; phi += 23) {
            expect_same_slope(bard_of(cloth), {0, 0, 1}, direction(90, phi));
            expect_same_slope(bard_of(cloth), direction(50, phi), direction(90, phi + 90));
        }
}

TEST(Bard, ToleratesGaps) {
    const Cloth cloth = satin_cloth();
    ReflectanceTable table = normal_table(cloth, even_grid(5, 15));
    std::erase_if(table.rows, [](const ReflectanceRow &r) {
        const double theta = r.theta_r / kDegree, phi = r.phi_r / kDegree;
        return theta > 28 && theta < 42 && phi > 40 && phi < 80;
    });
    const Bard bard = fit(table);
    const glm::dvec3 missing = direction(35, 60);
    EXPECT_NEAR(bard.at(missing) / reflectance(cloth, {0, 0, 1}, missing), 1, 0.1);
}

TEST(Bard, RepeatedViewsAreAveraged) {
    ReflectanceTable table = normal_table(isotropic_cloth(), even_grid(10, 30));
    const double at30 = reflectance(isotropic_cloth(), {0, 0, 1}, direction(30, 0));
    for (ReflectanceRow &row : table.rows)
        if (std::abs(row.theta_r - 30 * kDegree) < 1e-9 && row.phi_r == 0)
            row.brdf_per_sr = 0.9 * at30;
    table.rows.push_back(view(30, 0, 1.1 * at30));
    const Bard bard = fit(table);
    EXPECT_NEAR(bard.at(direction(30, 0)), at30, 0.01 * at30);
    const double expected =
        std::sqrt((std::pow(std::log10(0.9), 2) + std::pow(std::log10(1.1), 2)) / 2);
    EXPECT_NEAR(bard.asymmetry(), expected, 1e-9);
    EXPECT_EQ(bard.views().size(), table.rows.size());
}

// Views at phi and phi + 180 degrees on the edges of the domain are the same under the half turn.
TEST(Bard, AsymmetryIsReportedForEverySymmetry) {
    for (const Symmetry symmetry : {Symmetry::orthotropic, Symmetry::half_turn})
        for (const double phi : {0.0, 30.0, 90.0, 180.0}) {
            ReflectanceTable table = normal_table(isotropic_cloth(), even_grid(15, 45));
            std::erase_if(table.rows, [](const auto &r) { return r.theta_r > 50 * kDegree; });
            table.symmetry = symmetry;
            table.rows.push_back(view(70, phi, 0.012));
            table.rows.push_back(view(70, phi + 180, 0.008));
            const Bard bard = fit(table);
            EXPECT_GT(bard.asymmetry(), 0.05) << name_of(symmetry) << " " << phi;
            EXPECT_NEAR(bard.at(direction(70, phi)), 0.01, 2e-4) << name_of(symmetry) << " " << phi;
        }
    ReflectanceTable table = normal_table(leaning_cloth(), even_grid(15, 45));
    EXPECT_EQ(fit(table).asymmetry(), 0);
}

TEST(Bard, NoisyViewsCountLess) {
    ReflectanceTable table = normal_table(isotropic_cloth(), even_grid(6, 15));
    const double exact = reflectance(isotropic_cloth(), {0, 0, 1}, direction(30, 45));
    for (ReflectanceRow &row : table.rows)
        if (std::abs(row.theta_r - 30 * kDegree) < 1e-9 &&
            std::abs(row.phi_r - 45 * kDegree) < 1e-9)
            row = view(30, 45, 2 * exact, 2 * exact);
    const BardSmoothness smoothness;
    const double doubted = Bard::fit(table, smoothness, "t").at(direction(30, 45));
    for (ReflectanceRow &row : table.rows)
        row.sigma_per_sr = 0;
    const double trusted = Bard::fit(table, smoothness, "t").at(direction(30, 45));
    EXPECT_NEAR(doubted, exact, 0.15 * exact);
    EXPECT_NEAR(trusted, 2 * exact, 0.02 * exact);
}

TEST(Bard, BlackStaysBlack) {
    ReflectanceTable table = normal_table(isotropic_cloth(), even_grid(15, 45));
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr = 0;
    const Bard bard = fit(table);
    EXPECT_EQ(bard.peak(), 0);
    EXPECT_EQ(bard.at({0, 0, 1}), 0);
    EXPECT_EQ(bard.residual(), 0);
}

void expect_refused(const ReflectanceTable &table) {
    try {
        Bard::fit(table, "satin.csv");
        FAIL() << "expected an Error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 1u);
        EXPECT_EQ(error.problems()[0].where, "satin.csv");
        EXPECT_FALSE(error.problems()[0].accepted.empty());
    }
}

TEST(Bard, RefusesTooFewViewsAndViewsTooNearToTheNormal) {
    const ReflectanceTable full = normal_table(isotropic_cloth(), even_grid(10, 30));
    ReflectanceTable few = full, near = full, oblique = full;
    few.rows.resize(5);
    std::erase_if(near.rows, [](const auto &r) { return r.theta_r > 15 * kDegree; });
    for (ReflectanceRow &row : oblique.rows)
        row.theta_i = 0.5; // no view has light from straight above
    expect_refused(few);
    expect_refused(near);
    expect_refused(oblique);
    expect_refused({});
}

// One fault each, and one error that says which.
TEST(Bard, RefusesTablesThatAreNone) {
    const ReflectanceTable good = normal_table(satin_cloth(), even_grid(10, 15));
    const auto told = [](const ReflectanceTable &table) {
        try {
            Bard::fit(table, BardSmoothness{}, "t");
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().size(), 1u);
            EXPECT_EQ(error.problems()[0].where, "t");
            EXPECT_FALSE(error.problems()[0].accepted.empty());
            return error.problems()[0].what;
        }
        return std::string("nothing");
    };
    const auto changed = [&](const auto &change) {
        ReflectanceTable table = good;
        change(table);
        return told(table);
    };
    EXPECT_EQ(told(good), "nothing");
    EXPECT_NE(changed([](auto &t) { t.rows[9].brdf_per_sr = NAN; }).find("nan"), std::string::npos);
    EXPECT_NE(changed([](auto &t) { t.rows[9].brdf_per_sr = -1; }).find("-1"), std::string::npos);
    EXPECT_NE(changed([](auto &t) { t.rows[9].theta_r = 2; }).find("above the cloth"),
              std::string::npos);
    EXPECT_NE(changed([](auto &t) {
                  t.rows.push_back(t.rows[9]);
                  t.rows.back().brdf_per_sr *= 3;
              }).find("measured twice"),
              std::string::npos);
    EXPECT_NE(changed([](auto &t) {
                  for (ReflectanceRow &row : t.rows)
                      row.brdf_per_sr *= 10000;
              }).find("times what they receive"),
              std::string::npos);
    EXPECT_NE(changed([](auto &t) {
                  std::erase_if(t.rows, [](const auto &r) { return r.phi_r > 20 * kDegree; });
              }).find("15 degrees of azimuth"),
              std::string::npos);
    for (const Symmetry symmetry : {Symmetry::half_turn, Symmetry::none}) {
        ReflectanceTable sector = good;
        sector.symmetry = symmetry;
        std::erase_if(sector.rows, [](const auto &r) { return r.phi_r > 50 * kDegree; });
        EXPECT_NE(told(sector).find("45 degrees of azimuth"), std::string::npos);
    }
}

// Twisted yarn measured over the whole turn and declared orthotropic; and the same with noise that
// explains the difference.
TEST(Bard, RefusesASymmetryThatTheViewsContradict) {
    Cloth cloth = twisted_cloth();
    cloth.symmetry = Symmetry::none;
    ReflectanceTable table = normal_table(cloth, even_grid(10, 15));
    table.symmetry = Symmetry::half_turn;
    EXPECT_LT(Bard::fit(table, BardSmoothness{}, "t").asymmetry(), 1e-6);
    table.symmetry = Symmetry::orthotropic;
    expect_refused(table);
    for (ReflectanceRow &row : table.rows)
        row.sigma_per_sr = row.brdf_per_sr;
    EXPECT_GT(Bard::fit(table, BardSmoothness{}, "t").asymmetry(), 0.1);
}

// A highlight that is turned on a level ground, which makes most mirror images equal; and one that
// is off by a seventh on one side, which is averaged and told.
TEST(Bard, RefusesATurnedHighlightOnALevelGround) {
    const auto table = [](double turn_deg, double one_side) {
        ReflectanceTable made{.symmetry = Symmetry::orthotropic};
        for (double theta = 0; theta <= 80; theta += 10)
            for (double phi = 0; phi < (theta > 0 ? 360 : 1); phi += 15) {
                const glm::dvec3 d = direction(theta, phi - turn_deg);
                const double value = 0.02 + 0.4 * std::exp(-d.x * d.x / 0.3 - d.y * d.y / 0.02);
                made.rows.push_back(view(theta, phi, value * (phi < 180 ? one_side : 1)));
            }
        return made;
    };
    expect_refused(table(25, 1));
    const Bard averaged = fit(table(0, 1.15));
    EXPECT_NEAR(averaged.asymmetry(), 0.03, 0.005);
}

TEST(FeaturePoints, AreReadOffTheSurface) {
    const Bard bard = bard_of(satin_cloth());
    const auto points = feature_points(bard, 0.05);
    ASSERT_EQ(points.size(), 6u);
    EXPECT_EQ(points[0].name, "F0");
    EXPECT_NEAR(points[0].brdf_per_sr, bard.at({0, 0, 1}), 1e-12);
    // Eq. 3 at the normal: D = rho0 / f0
    EXPECT_NEAR(points[0].facets_per_sr, bard.at({0, 0, 1}) / 0.05, 1e-4);
    EXPECT_EQ(points[5].name, "Fxz");
    EXPECT_NEAR(points[5].brdf_per_sr, bard.at(direction(45, 0)), 1e-12);
    EXPECT_NEAR(points[2].brdf_per_sr, points[4].brdf_per_sr, 1e-9); // mirror images
    EXPECT_NEAR(shown_tilt(bard), 45 * kDegree, 1e-9);
    EXPECT_FALSE(points[2].extrapolated);
    ReflectanceTable near = normal_table(satin_cloth(), even_grid(10, 15));
    std::erase_if(near.rows, [](const auto &r) { return r.theta_r > 61 * kDegree; });
    const Bard short_sighted = Bard::fit(near, BardSmoothness{}, "t");
    EXPECT_NEAR(shown_tilt(short_sighted), 30 * kDegree, 1e-9);
    EXPECT_TRUE(feature_points(short_sighted, 0.05)[2].extrapolated);
}

TEST(Misfits, NameTheViewThatDoesNotFit) {
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(6, 15));
    const BardSmoothness rough{.noise_share = 1e-2};
    EXPECT_TRUE(misfits(Bard::fit(table, rough, "t")).empty());
    for (ReflectanceRow &row : table.rows)
        if (std::abs(row.theta_r - 30 * kDegree) < 1e-9 &&
            std::abs(row.phi_r - 45 * kDegree) < 1e-9)
            row.brdf_per_sr *= 5;
    const auto found = misfits(Bard::fit(table, rough, "t"));
    // The surface bends to it, away from its neighbours
    ASSERT_FALSE(found.empty());
    EXPECT_LE(found.size(), 4u);
    EXPECT_NEAR(found[0].theta, 30 * kDegree, 1e-9);
    EXPECT_NEAR(found[0].phi, 45 * kDegree, 1e-9);
}

TEST(Misfits, LeaveOutWhatNobodySees) {
    const auto found = [](double measured) { // a tenth of what is fitted
        const std::vector<ModelledView> views{
            {{.theta_r = 0.2, .brdf_per_sr = 1}, 1},
            {{.theta_r = 0.4, .brdf_per_sr = 1}, 1.001},
            {{.theta_r = 0.6, .brdf_per_sr = 1}, 0.999},
            {{.theta_r = 0.8, .brdf_per_sr = 1}, 1},
            {{.theta_r = 0.9, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.0, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.1, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.2, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.3, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.4, .brdf_per_sr = 1}, 1},
            {{.theta_r = 1.5, .brdf_per_sr = measured}, 10 * measured}};
        return misfits(views).size();
    };
    EXPECT_EQ(found(1e-2), 1u);
    EXPECT_EQ(found(1e-4), 0u);
}

} // namespace
} // namespace tsuya::test

#include "tsuya/sdk/yarn.h"

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

constexpr int kLevel = kYarnSlopes / 2;

// A warp-faced cloth: level floats that dip at 10 degrees, over a weft that lies level.
YarnLobes satin_lobes() {
    YarnLobes lobes{.f0 = 0.053, .roughness = 0.06, .even = 0.002};
    lobes.surface[1][kLevel] = 0.8;
    lobes.surface[1][kLevel - 5] = lobes.surface[1][kLevel + 5] = 0.1;
    lobes.surface[0][kLevel] = 0.25;
    lobes.pit = {0.3, 0};
    return lobes;
}

ReflectanceTable table_of(const YarnBrdf &brdf, double theta_i_deg, double phi_i_deg) {
    ReflectanceTable table = normal_table(satin_cloth(), even_grid(6, 10));
    const double phi_to = theta_i_deg > 0 ? 360 : 95;
    table.symmetry = theta_i_deg > 0 ? Symmetry::none : Symmetry::orthotropic;
    table.rows.clear();
    for (double theta = 0; theta < 89; theta += 5)
        for (double phi = 0; phi < phi_to && (theta > 0 || phi == 0); phi += 5)
            table.rows.push_back(
                {theta_i_deg * kDegree, phi_i_deg * kDegree, theta * kDegree, phi * kDegree,
                 static_cast<double>(brdf.evaluate(glm::vec3(direction(theta_i_deg, phi_i_deg)),
                                                   glm::vec3(direction(theta, phi))))});
    return table;
}

TEST(FilamentBed, LetsLevelFilamentsSeeAllButEachOther) {
    const FilamentBed bed(0); // no flanks
    const auto at = [&](double light_deg, double viewer_deg) {
        const auto angle = [](double deg) {
            return bed_angle(static_cast<float>(std::sin(deg * kDegree)),
                             static_cast<float>(std::cos(deg * kDegree)));
        };
        return bed.at(angle(light_deg), angle(viewer_deg));
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
    EXPECT_GT(flat.at(grazing, -grazing), 0.99f);
    EXPECT_LT(round.at(grazing, -grazing), 0.4f);
    EXPECT_GT(round.at(0, 0), 0.6f);
}

TEST(YarnLobes, AreFoundAgainInTheViewsTheyMake) {
    const YarnLobes made = satin_lobes();
    const YarnBrdf brdf(made);
    const YarnLobes found = fit_yarn_lobes(Bard::fit(table_of(brdf, 0, 0), {}, "cloth"), made.f0);
    EXPECT_EQ(found.roughness, made.roughness);
    for (const int axis : {0, 1}) {
        double surface = 0, expected = 0;
        for (int k = 0; k < kYarnSlopes; ++k) {
            surface += found.surface[axis][k];
            expected += made.surface[axis][k];
        }
        EXPECT_NEAR(surface / expected, 1, 0.1) << axis;
    }
    EXPECT_NEAR(found.pit[0], 0.3, 0.03); // a face with little weft: it lies deep
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

// Crossing yarns with equal shares of the face, of which the weft lies deeper than light from above
// tells: two views under each of six lights.
YarnLobes uneven_lobes() {
    YarnLobes lobes{.f0 = 0.053, .roughness = 0.08, .even = 0.001};
    for (const int axis : {0, 1})
        for (int k = -8; k <= 8; ++k)
            lobes.surface[axis][kLevel + k] = 0.05;
    lobes.pit = {0.2, 0};
    return lobes;
}

ReflectanceTable a_dozen(const YarnBrdf &brdf) {
    ReflectanceTable table;
    for (const auto &[theta, phi] :
         {std::pair{45, 45}, {60, 0}, {60, 45}, {60, 90}, {75, 0}, {75, 90}})
        for (const double beside : {0.0, 36.0})
            table.rows.push_back(
                {theta * kDegree, phi * kDegree, theta * kDegree, (phi + 180 + beside) * kDegree,
                 static_cast<double>(
                     brdf.evaluate(glm::vec3(direction(theta, phi)),
                                   glm::vec3(direction(theta, phi + 180 + beside))))});
    return table;
}

TEST(YarnLobes, FindPitsInADozenObliqueViews) {
    const YarnLobes made = uneven_lobes();
    const YarnBrdf brdf(made);
    const Bard bard = Bard::fit(table_of(brdf, 0, 0), {}, "cloth");
    const YarnLobes above = fit_yarn_lobes(bard, made.f0);
    const YarnLobes found = fit_yarn_lobes(bard, a_dozen(brdf), made.f0, "cloth");
    EXPECT_EQ(above.pit[0], 0); // equal shares: light from above takes them for level
    EXPECT_NEAR(found.pit[0], 0.2, 0.026);
    EXPECT_NEAR(found.pit[1], 0, 0.026);
    EXPECT_EQ(found.roughness, made.roughness);
    const YarnBrdf blind(above), seeing(found);
    const auto error = [&](const YarnBrdf &model, double theta, double phi) {
        return *measure_accuracy(table_of(brdf, theta, phi), [&](const auto &l, const auto &v) {
                    return static_cast<double>(model.evaluate(glm::vec3(l), glm::vec3(v)));
                }).mean.l2_cos;
    };
    EXPECT_LT(error(seeing, 66, 10), 0.1); // a light that was not shown
    EXPECT_GT(error(blind, 66, 10), 0.2);
}

TEST(YarnLobes, RefuseObliqueViewsThatTellNothing) {
    const YarnBrdf brdf(uneven_lobes());
    const Bard bard = bard_of(satin_cloth());
    const auto refused = [&](const ReflectanceTable &table, const std::string &what) {
        try {
            fit_yarn_lobes(bard, table, 0.05, "t.csv");
            ADD_FAILURE() << "expected an Error: " << what;
        } catch (const Error &error) {
            ASSERT_EQ(error.problems().size(), 1u) << what;
            EXPECT_EQ(error.problems()[0].where.rfind("t.csv", 0), 0u);
            EXPECT_NE(error.problems()[0].what.find(what), std::string::npos)
                << error.problems()[0].what;
            EXPECT_FALSE(error.problems()[0].accepted.empty());
        }
    };
    ReflectanceTable table = a_dozen(brdf);
    refused(table_of(brdf, 0, 0), "0 views under oblique light");
    table.rows.resize(3);
    refused(table, "3 views under oblique light");
    table = a_dozen(brdf);
    for (ReflectanceRow &row : table.rows)
        row.brdf_per_sr *= row.theta_i > 70 * kDegree && row.phi_i > 1 ? 0 : 1;
    refused(table, "theta_i 75, phi_i 90 degrees are all 0");
    table = a_dozen(brdf);
    table.rows[5].brdf_per_sr = std::nan("");
    refused(table, "");
    table = a_dozen(brdf);
    table.rows.push_back(table.rows[4]);
    table.rows.back().brdf_per_sr *= 5; // contradicts its twin
    refused(table, "");
    EXPECT_THROW(fit_yarn_lobes(bard, a_dozen(brdf), 0, "t.csv"), Error);
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
    EXPECT_NEAR(at(deep, 45, 0) / at(level, 45, 0), 0.4, 0.01);
    EXPECT_NEAR(at(deep, 60, 0), 0, 1e-6);
    EXPECT_NEAR(at(deep, 45, 90) / at(level, 45, 90), 1, 0.01);
    EXPECT_NEAR(at(other, 45, 0) / at(level, 45, 0), 1, 1e-5);
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

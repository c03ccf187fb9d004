// Filaments from views under oblique light.

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/synthetic_table.h"
#include "sdk/yarn_table.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya::test {
namespace {

constexpr int kLevel = kYarnSlopes / 2;

// Crossing yarns with equal shares of the face, of which the weft lies deeper than light from above
// tells: two views under each of six lights.
YarnLobes uneven_lobes() {
    YarnLobes lobes{.f0 = 0.053, .roughness = 0.08};
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

TEST(ObliqueFit, FindsPitsInADozenObliqueViews) {
    const YarnLobes made = uneven_lobes();
    const YarnBrdf brdf(made);
    const Bard bard = Bard::fit(table_of(brdf, 0, 0), {}, "cloth");
    const YarnLobes above = fit_yarn_lobes(bard, made.f0);
    const ObliqueFit fit = fit_yarn_lobes(bard, a_dozen(brdf), made.f0, "cloth");
    const YarnLobes &found = fit.lobes;
    EXPECT_TRUE(fit.kept);
    EXPECT_LT(fit.left_out_l2_cos, 0.5 * fit.from_above_l2_cos);
    EXPECT_EQ(above.pit[0], 0); // equal shares: light from above takes them for level
    EXPECT_NEAR(found.pit[0], 0.2, 0.026);
    EXPECT_NEAR(found.pit[1], 0, 0.026);
    EXPECT_EQ(found.roughness, above.roughness);
    const YarnBrdf blind(above), seeing(found);
    const auto error = [&](const YarnBrdf &model, double theta, double phi) {
        return *measure_accuracy(table_of(brdf, theta, phi), [&](const auto &l, const auto &v) {
                    return static_cast<double>(model.evaluate(glm::vec3(l), glm::vec3(v)));
                }).mean.l2_cos;
    };
    EXPECT_LT(error(seeing, 66, 10), 0.1); // a light that was not shown
    EXPECT_GT(error(blind, 66, 10), 0.2);
}

// Views that contradict each other: three times too bright and too dark by turns.
TEST(ObliqueFit, IsNotKeptWhereViewsAreNoise) {
    const YarnLobes made = uneven_lobes();
    const YarnBrdf brdf(made);
    const Bard bard = Bard::fit(table_of(brdf, 0, 0), {}, "cloth");
    ReflectanceTable noise = a_dozen(brdf);
    for (std::size_t i = 0; i < noise.rows.size(); ++i)
        noise.rows[i].brdf_per_sr *= (i + i / 2) % 2 == 0 ? 3 : 1.0 / 3;
    const ObliqueFit fit = fit_yarn_lobes(bard, noise, made.f0, "cloth");
    EXPECT_FALSE(fit.kept);
    EXPECT_GT(fit.left_out_l2_cos, fit.from_above_l2_cos);
    EXPECT_EQ(fit.lobes, fit_yarn_lobes(bard, made.f0)) << "bit for bit";
}

// Wrong rows beside the right ones, which say themselves that they may be wrong.
TEST(ObliqueFit, TrustsViewsByTheirSigma) {
    const YarnLobes made = uneven_lobes();
    const YarnBrdf brdf(made);
    const Bard bard = Bard::fit(table_of(brdf, 0, 0), {}, "cloth");
    ReflectanceTable table = a_dozen(brdf);
    for (const ReflectanceRow &right : a_dozen(brdf).rows) {
        ReflectanceRow wrong = right;
        wrong.theta_r -= 8 * kDegree;
        wrong.brdf_per_sr *= table.rows.size() % 2 == 0 ? 4 : 0.1;
        wrong.sigma_per_sr = 4 * right.brdf_per_sr;
        table.rows.push_back(wrong);
    }
    const ObliqueFit trusting = fit_yarn_lobes(bard, table, made.f0, "cloth");
    EXPECT_TRUE(trusting.kept);
    EXPECT_NEAR(trusting.lobes.pit[0], made.pit[0], 0.026);
    EXPECT_NEAR(trusting.lobes.pit[1], made.pit[1], 0.026);
    for (ReflectanceRow &row : table.rows)
        row.sigma_per_sr = 0;
    const ObliqueFit blind = fit_yarn_lobes(bard, table, made.f0, "cloth");
    EXPECT_GT(std::abs(blind.lobes.pit[0] - made.pit[0]), 0.1) << "control";
}

// The mirror image of a light tells nothing that the light does not.
TEST(ObliqueFit, LeavesOutLightsThatTheSymmetryMakesOne) {
    const YarnLobes made = uneven_lobes();
    const YarnBrdf brdf(made);
    const Bard bard = Bard::fit(table_of(brdf, 0, 0), {}, "cloth");
    ReflectanceTable table{.symmetry = Symmetry::orthotropic};
    for (const double phi : {40.0, 140.0, 320.0})
        for (const ReflectanceRow &row : table_of(brdf, 60, phi).rows)
            if (row.theta_r > 44 * kDegree && row.theta_r < 66 * kDegree)
                table.rows.push_back(row);
    const ObliqueFit one = fit_yarn_lobes(bard, table, made.f0, "cloth");
    EXPECT_FALSE(one.kept) << "one light in three places";
    EXPECT_EQ(one.left_out_l2_cos, one.from_above_l2_cos);
    table.symmetry = Symmetry::none; // control
    EXPECT_TRUE(fit_yarn_lobes(bard, table, made.f0, "cloth").kept);
}

TEST(ObliqueFit, RefusesViewsThatTellNothing) {
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

} // namespace
} // namespace tsuya::test

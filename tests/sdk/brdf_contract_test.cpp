#include "tsuya/sdk/body.h"

#include <cstdlib>
#include <iostream>
#include <memory>

#include <gtest/gtest.h>

#include "sdk/brdf_checks.h"
#include "sdk/synthetic_table.h"

namespace tsuya::test {
namespace {

constexpr std::uint64_t kSeed = 20240917;

// TSUYA_TEST_EFFORT multiplies the draws: ctest runs this program a second time with more of them.
int effort() {
    const char *text = std::getenv("TSUYA_TEST_EFFORT");
    return text ? std::max(1, std::atoi(text)) : 1;
}

AnyBrdf any(const Brdf &brdf) {
    return brdf.visit([](const auto &model) { return any_brdf(model); });
}

struct Instance {
    std::string name;
    std::function<AnyBrdf()> make;
    // How well the tables of albedos must agree with quadrature; the view's at grazing are worse
    double light_tolerance = 0.02, view_tolerance = 0.05;
    // Densities with wide steps at grazing need more of the quadrature, or are left to the run with
    // more effort
    int evaluations = 80000;
    double to_deg = 89.9;
    int energy_evaluations = 30000;
};

Instance takeda(const char *name, Cloth (*cloth)(), double f0) {
    return {name, [=] { return any(TakedaBrdf(bard_of(cloth()), f0)); }};
}

// Without the half turn the densities have a step where the slope of the map has one, and the
// weights of grazing lights vary, and the tables with them.
Instance takeda_leaning() {
    Instance instance = takeda("TakedaLeaning", leaning_cloth, 0.05);
    instance.light_tolerance = 0.05;
    instance.evaluations = 500000;
    instance.to_deg = 85;
    return instance;
}

Instance half_vector(const char *name, Cloth (*cloth)(), double f0) {
    Instance instance{name, [=] { return any(HalfVectorBrdf(bard_of(cloth()), f0)); }};
    instance.energy_evaluations = 60000;
    return instance;
}

Instance printed(const char *name, Cloth (*cloth)(), double f0) {
    return {name, [=] { return any(TakedaPrintedBrdf(bard_of(cloth()), f0)); }, 0.2, 0.2, 500000,
            89};
}

Instance ggx(const char *name, const GgxFacets &facets) {
    return {name, [=] { return any(GgxBrdf(facets)); }};
}

Instance yarn(const char *name, Cloth (*cloth)(), double f0) {
    // At 89.5 degrees and beyond the albedo changes fast with azimuth
    return {name, [=] { return any(YarnBrdf(bard_of(cloth()), f0)); }, 0.06, 0.05, 200000};
}

// The coloured part below the surface of the same yarns.
Instance body(const char *name, Cloth (*cloth)(), double f0) {
    return {name, [=] { return any_brdf(BodyBrdf(YarnBrdf(bard_of(cloth()), f0))); }, 0.06, 0.05,
            200000};
}

std::vector<Instance> instances() {
    return {{"Lambert", [] { return any(LambertBrdf()); }, 1e-3, 1e-3},
            {"LambertGrey", [] { return any(LambertBrdf(0.3f)); }, 1e-3, 1e-3},
            ggx("Ggx", {.alpha_weft = 0.4, .alpha_warp = 0.12}),
            ggx("GgxGlass", {.alpha_weft = 0.1, .alpha_warp = 0.3, .refractive_index = 1.5}),
            ggx("GgxMirrors", {.alpha_weft = 0.1, .alpha_warp = 0.08, .f0 = 1}),
            printed("TakedaPrintedSatin", satin_cloth, 0.05),
            printed("TakedaPrintedTwisted", twisted_cloth, 0.05),
            {"TabulatedSatin",
             [] { return any(TabulatedBrdf(paper_table(satin_cloth(), 6, 15), "table")); }, 0.25,
             0.25, 500000, 89},
            takeda("TakedaSatin", satin_cloth, 0.05),
            takeda("TakedaIsotropic", isotropic_cloth, 0.3),
            takeda("TakedaNarrow", narrow_cloth, 0.9),
            takeda("TakedaTwisted", twisted_cloth, 0.05),
            takeda_leaning(),
            half_vector("HalfVectorSatin", satin_cloth, 0.05),
            half_vector("HalfVectorNarrow", narrow_cloth, 0.9),
            half_vector("HalfVectorTwisted", twisted_cloth, 0.05),
            half_vector("HalfVectorLeaning", leaning_cloth, 0.05),
            yarn("YarnSatin", satin_cloth, 0.05),
            yarn("YarnNarrow", narrow_cloth, 0.9),
            yarn("YarnTwisted", twisted_cloth, 0.05),
            yarn("YarnLeaning", leaning_cloth, 0.05),
            body("BodySatin", satin_cloth, 0.05),
            body("BodyNarrow", narrow_cloth, 0.9),
            body("BodyTwisted", twisted_cloth, 0.05),
            body("BodyLeaning", leaning_cloth, 0.05)};
}

class BrdfContract : public testing::TestWithParam<Instance> {
  protected:
    // Every test of a model uses one copy of it: the tables are long in the making
    const AnyBrdf &brdf() const {
        static std::map<std::string, AnyBrdf> made;
        const auto found = made.find(GetParam().name);
        if (found != made.end())
            return found->second;
        return made[GetParam().name] = GetParam().make();
    }
};

void expect(const Check &check) {
    EXPECT_TRUE(check.passed) << check.worst << " at " << check.where;
}

TEST_P(BrdfContract, ValuesAreFiniteAndNotNegative) { expect(check_values(brdf())); }
TEST_P(BrdfContract, NothingBelowTheHorizon) { expect(check_horizon(brdf())); }
TEST_P(BrdfContract, WeightsAreValueOverDensity) { expect(check_weights(brdf())); }
TEST_P(BrdfContract, ReciprocityIsAsDeclared) { expect(check_reciprocity(brdf())); }
TEST_P(BrdfContract, EnergyIsLimitedAndTold) {
    const Energy energy =
        check_energy(brdf(), GetParam().light_tolerance, GetParam().energy_evaluations * effort());
    expect(energy.limit);
    expect(energy.albedo);
}

TEST_P(BrdfContract, AlbedoOfView) {
    expect(check_albedo_of_view(brdf(), GetParam().view_tolerance,
                                GetParam().energy_evaluations * effort()));
}

TEST_P(BrdfContract, DrawsFollowTheirDensity) {
    std::cout << "seed " << kSeed << "\n";
    const Check check = check_draws(brdf(),
                                    {.samples = 20000 * effort(),
                                     .evaluations = GetParam().evaluations,
                                     .to_deg = effort() > 1 ? 89.9 : GetParam().to_deg},
                                    kSeed);
    EXPECT_TRUE(check.passed) << check.where;
}

INSTANTIATE_TEST_SUITE_P(All, BrdfContract, testing::ValuesIn(instances()),
                         [](const auto &tested) { return tested.param.name; });

} // namespace
} // namespace tsuya::test

// Deliberately wrong models: every check of the contract must find its own.

#include <cmath>
#include <iostream>

#include <gtest/gtest.h>

#include "sdk/brdf_checks.h"
#include "sdk/hemisphere_quadrature.h"
#include "sdk/synthetic_table.h"

namespace tsuya::test {
namespace {

constexpr std::uint64_t kSeed = 20240918;
constexpr int kSamples = 20000;
constexpr int kEvaluations = 30000;

using Vector = glm::vec3;
using Drawn = std::optional<SampledDirection>;

// A density 5 % too high; the weights agree with it.
struct WrongFactor : LambertBrdf {
    static constexpr float kFactor = 1.05f;
    float pdf(const Vector &l, const Vector &v) const { return kFactor * LambertBrdf::pdf(l, v); }
    Drawn sample(const Vector &v, const Vector &u) const {
        Drawn s = LambertBrdf::sample(v, u);
        if (s)
            s = {s->direction, s->weight / kFactor, s->pdf_per_sr * kFactor};
        return s;
    }
};

// Draws a little too near to the weft axis, with the pdf of the even draw.
struct SkewedSampler : LambertBrdf {
    Drawn sample(const Vector &v, const Vector &u) const {
        return LambertBrdf::sample(v, {std::pow(u.x, 1.1f), u.y, u.z});
    }
};

struct SkewedAdjoint : LambertBrdf {
    Drawn sample_adjoint(const Vector &l, const Vector &u) const {
        return LambertBrdf::sample_adjoint(l, {u.x, std::pow(u.y, 1.1f), u.z});
    }
};

// Loses a tenth of the draws that its pdf promises.
struct HiddenNulls : LambertBrdf {
    Drawn sample(const Vector &v, const Vector &u) const {
        return u.z < 0.1f ? std::nullopt : LambertBrdf::sample(v, u);
    }
};

struct WrongWeight : LambertBrdf {
    Drawn sample(const Vector &v, const Vector &u) const {
        Drawn s = LambertBrdf::sample(v, u);
        if (s)
            s->weight *= 1.001f;
        return s;
    }
};

struct WrongCosine : LambertBrdf {
    float evaluate_cos(const Vector &l, const Vector &v) const { return evaluate(l, v) * v.z; }
};

struct OneSided : LambertBrdf {
    float evaluate(const Vector &l, const Vector &v) const {
        return LambertBrdf::evaluate(l, v) * (1 + 0.2f * l.x);
    }
};

struct DeniesReciprocity : LambertBrdf {
    static constexpr bool kReciprocal = false;
};

struct CreatesEnergy : LambertBrdf {
    float evaluate(const Vector &l, const Vector &v) const {
        return LambertBrdf::evaluate(l, v) * (1.05f - 0.05f * l.z);
    }
};

struct NotANumber : LambertBrdf {
    float evaluate(const Vector &l, const Vector &v) const {
        return LambertBrdf::evaluate(l, v) * (l.z < 1e-3f ? std::sqrt(-l.z) : 1.0f);
    }
};

struct Negative : LambertBrdf {
    float pdf(const Vector &l, const Vector &v) const {
        return LambertBrdf::pdf(l, v) - (l.z < 0.01f ? 0.01f : 0.0f);
    }
};

struct LightFromBelow : LambertBrdf {
    float evaluate(const Vector &, const Vector &) const { return 0.3f; }
};

struct WrongViewAlbedo : LambertBrdf {
    float albedo_of_view(const Vector &v) const { return v.z > 0 ? 0.9f + 0.1f * v.z : 0.0f; }
};

struct WrongLightAlbedo : LambertBrdf {
    float albedo_of_light(const Vector &l) const { return l.z > 0 ? 0.9f + 0.1f * l.z : 0.0f; }
};

// Far fewer even draws than the pdf has beside those by the half vector.
struct SkewedTakeda : TakedaBrdf {
    using TakedaBrdf::TakedaBrdf;
    Drawn sample(const Vector &v, const Vector &u) const {
        return TakedaBrdf::sample(v, {u.x, u.y, std::pow(u.z, 8.0f)});
    }
};

template <class Model> AnyBrdf wrong() { return any_brdf(Model()); }

TEST(BrdfControl, TheRightModelPassesAll) {
    const AnyBrdf brdf = wrong<LambertBrdf>();
    EXPECT_TRUE(check_values(brdf).passed);
    EXPECT_TRUE(check_horizon(brdf).passed);
    EXPECT_TRUE(check_weights(brdf).passed);
    EXPECT_TRUE(check_reciprocity(brdf).passed);
    EXPECT_TRUE(check_energy(brdf, 1e-3, kEvaluations).limit.passed);
    EXPECT_TRUE(check_energy(brdf, 1e-3, kEvaluations).albedo.passed);
    EXPECT_TRUE(check_albedo_of_view(brdf, 1e-3, kEvaluations).passed);
    EXPECT_TRUE(check_draws(brdf, {kSamples}, kSeed).passed);
}

TEST(BrdfControl, DensitiesThatDoNotIntegrateToOneFail) {
    std::cout << "seed " << kSeed << "\n";
    EXPECT_FALSE(check_draws(wrong<WrongFactor>(), {kSamples}, kSeed).passed);
    EXPECT_FALSE(check_draws(wrong<HiddenNulls>(), {kSamples}, kSeed).passed);
}

TEST(BrdfControl, SkewedSamplersFailTheChiSquare) {
    const double threshold = sidak_threshold(2 * static_cast<int>(fixed_directions().size()));
    EXPECT_LT(check_draws(wrong<SkewedSampler>(), {kSamples}, kSeed).worst, threshold);
    EXPECT_LT(check_draws(wrong<SkewedAdjoint>(), {kSamples}, kSeed).worst, threshold);
    const SkewedTakeda skewed(bard_of(satin_cloth()), 0.05);
    EXPECT_LT(check_draws(any_brdf(skewed), {kSamples}, kSeed).worst, threshold);
}

TEST(BrdfControl, WrongWeightsFail) {
    EXPECT_FALSE(check_weights(wrong<WrongWeight>()).passed);
    EXPECT_FALSE(check_weights(wrong<WrongCosine>()).passed);
    EXPECT_FALSE(check_weights(wrong<SkewedSampler>()).worst > 1e-5)
        << "its weights are consistent";
}

TEST(BrdfControl, AFalseClaimOfReciprocityFailsEitherWay) {
    EXPECT_FALSE(check_reciprocity(wrong<OneSided>()).passed);
    EXPECT_FALSE(check_reciprocity(wrong<DeniesReciprocity>()).passed);
}

TEST(BrdfControl, CreatedEnergyFails) {
    EXPECT_FALSE(check_energy(wrong<CreatesEnergy>(), 1, kEvaluations).limit.passed);
}

TEST(BrdfControl, WrongAlbedosFail) {
    EXPECT_FALSE(check_energy(wrong<WrongLightAlbedo>(), 0.05, kEvaluations).albedo.passed);
    EXPECT_FALSE(check_albedo_of_view(wrong<WrongViewAlbedo>(), 0.05, kEvaluations).passed);
}

TEST(BrdfControl, ValuesThatAreNoneFail) {
    EXPECT_FALSE(check_values(wrong<NotANumber>()).passed);
    EXPECT_FALSE(check_values(wrong<Negative>()).passed);
}

TEST(BrdfControl, ValuesBelowTheHorizonFail) {
    EXPECT_FALSE(check_horizon(wrong<LightFromBelow>()).passed);
}

// Quantiles of the chi-square distribution from printed tables.
TEST(ChiSquare, TailMeetsPrintedQuantiles) {
    EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 5e-4);
    EXPECT_NEAR(chi_square_tail(124.342, 100), 0.05, 2e-4);
    EXPECT_NEAR(chi_square_tail(135.807, 100), 0.01, 2e-4);
    EXPECT_NEAR(chi_square_tail(70.065, 100), 0.99, 2e-4);
}

TEST(Quadrature, ResolvesSteps) {
    const auto cap = [](const glm::vec3 &d) { return d.x > 0.95f ? 1.0 : 0.0; };
    // Half of a cap about the horizontal weft axis
    EXPECT_NEAR(integrate(cap, 40000), M_PI * 0.05, 1e-3);
}

} // namespace
} // namespace tsuya::test

#include "tsuya/sdk/dye_depths.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/plan.h"

namespace tsuya {
namespace {

using Reflectances = std::array<double, kMostDyes>;
using Function = std::function<double(const Reflectances &)>;

DyeVariable variable(const char *name, double lowest, double highest) {
    return {.name = name, .open = true, .lowest = lowest, .highest = highest};
}

// As a share of the largest value.
double worst_error(const DyeDepths &depths, const Function &f) {
    const bool two = depths.dyes.size() > 1;
    const auto place = [](const DyeVariable &dye, int i) {
        return dye.lowest + (dye.highest - dye.lowest) * i / 20;
    };
    const DepthWeights weights(depths);
    const auto interpolated = [&](const Reflectances &at) {
        const std::vector<double> of_channels = weights.at(at);
        double sum = 0;
        for (std::size_t k = 0; k < of_channels.size(); ++k)
            sum += of_channels[k] * f(depths.node[k]);
        return sum;
    };
    double worst = 0, largest = 0;
    for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= (two ? 20 : 0); ++j) {
            const Reflectances at{place(depths.dyes[0], i), two ? place(depths.dyes[1], j) : 0};
            worst = std::max(worst, std::abs(interpolated(at) - f(at)));
            largest = std::max(largest, std::abs(f(at)));
        }
    return worst / largest;
}

TEST(DyeDepths, ReproduceEveryPolynomialOfTheirDegrees) {
    for (const int channels : {2, 8, 16}) {
        const DyeDepths depths = make_dye_depths({variable("a", 0.1, 0.9)}, channels);
        EXPECT_LT(worst_error(depths,
                              [&](const Reflectances &r) {
                                  return std::pow(r[0], channels - 1) - 0.3 * r[0] + 2;
                              }),
                  1e-11)
            << channels;
        // Negative control: one degree more
        EXPECT_GT(
            worst_error(depths, [&](const Reflectances &r) { return std::pow(r[0], channels); }),
            1e-11)
            << channels;
    }
    const DyeDepths two = make_dye_depths({variable("a", 0, 1), variable("b", 0, 1)}, 32);
    for (const auto &degree : two.degree)
        EXPECT_LT(worst_error(two,
                              [&](const Reflectances &r) {
                                  return std::pow(r[0], degree[0]) * std::pow(r[1], degree[1]);
                              }),
                  1e-9);
}

TEST(DyeDepths, WeightsAreOneAtTheirOwnNodeAndSumToOne) {
    for (const DyeDepths &depths :
         {make_dye_depths({variable("a", 0, 0.95)}, 8),
          make_dye_depths({variable("a", 0, 0.95), variable("b", 0.2, 0.5)}, 16)}) {
        const DepthWeights weights(depths);
        for (std::size_t n = 0; n < depths.node.size(); ++n) {
            const std::vector<double> at = weights.at(depths.node[n]);
            for (std::size_t k = 0; k < at.size(); ++k)
                EXPECT_NEAR(at[k], k == n ? 1 : 0, 1e-9);
        }
        double sum = 0;
        for (const double weight : weights.at({0.3, 0.4}))
            sum += weight;
        EXPECT_NEAR(sum, 1, 1e-10);
    }
}

// Light between two dyed cloths is a geometric series.
TEST(DyeDepths, CarryManyMeetingsWithDyedCloth) {
    const auto one = [](const Reflectances &r) { return r[0] / (1 - 0.7 * r[0]); };
    EXPECT_LT(worst_error(make_dye_depths({variable("a", 0, 0.98)}, 8), one), 2e-4);
    const auto two = [](const Reflectances &r) {
        return (r[0] + 0.5 * r[1]) / (1 - 0.4 * r[0] - 0.3 * r[1]);
    };
    EXPECT_LT(
        worst_error(make_dye_depths({variable("a", 0, 0.98), variable("b", 0, 0.98)}, 32), two),
        1e-3);
    EXPECT_LT(
        worst_error(make_dye_depths({variable("a", 0, 0.98), variable("b", 0.4, 0.6)}, 16), two),
        1e-3);
}

TEST(DyeDepths, AreLimitedToTheRangeOfTheDye) {
    const DepthWeights weights(make_dye_depths({variable("a", 0.2, 0.8)}, 8));
    EXPECT_EQ(weights.at({0.9}), weights.at({0.8}));
    EXPECT_EQ(weights.at({0.0}), weights.at({0.2}));
}

TEST(DyeDepths, AreRefusedWhereTheyDetermineNothing) {
    EXPECT_THROW(make_dye_depths({}, 8), Error);
    EXPECT_THROW(make_dye_depths({variable("a", 0.5, 0.5)}, 8), Error);
    EXPECT_THROW(make_dye_depths({variable("a", 0, 1.1)}, 8), Error);
    EXPECT_THROW(make_dye_depths({variable("a", 0, 1)}, 1), Error);
    EXPECT_THROW(
        make_dye_depths({variable("a", 0, 1), variable("b", 0, 1), variable("c", 0, 1)}, 8), Error);
    DyeDepths depths = make_dye_depths({variable("a", 0, 1)}, 8);
    depths.node[3] = depths.node[2];
    EXPECT_THROW(check_dye_depths(depths, "file"), Error);
}

TEST(DyeDepths, ShowAnotherDyeOnlyWhereItIsOpen) {
    DyeDepths depths = make_dye_depths({variable("a", 0, 1), variable("b", 0, 1)}, 16);
    depths.dyes[1].open = false;
    set_dye(depths, "", Spectrum::constant(0.25));
    EXPECT_EQ(depths.dyes[0].dye, Spectrum::constant(0.25));
    EXPECT_EQ(depths.dyes[1].dye, DyeVariable{}.dye);
    EXPECT_THROW(set_dye(depths, "b", Spectrum::constant(0.25)), Error);
    EXPECT_THROW(set_dye(depths, "c", Spectrum::constant(0.25)), Error);
    EXPECT_THROW(set_dye(depths, "a", Spectrum::constant(1.25)), Error);
}

Spectrum step(double below, double above) { return {{549, 551}, {below, above}}; }

TEST(DyeVariables, AreTheColoursThatVary) {
    Scene scene = test::folded_satin(8, 8);
    EXPECT_TRUE(dye_variables(scene).empty());
    scene.open_dyes = {FabricIndex{0}};
    ASSERT_EQ(dye_variables(scene).size(), 1u);
    EXPECT_TRUE(dye_variables(scene)[0].open);
    EXPECT_EQ(plan(scene, {}).channels, 8);
    scene.fabrics[1].colours.dye = step(0.2, 0.3);
    const std::vector<DyeVariable> two = dye_variables(scene);
    ASSERT_EQ(two.size(), 2u);
    EXPECT_FALSE(two[1].open);
    EXPECT_EQ(two[1].lowest, 0.2);
    EXPECT_EQ(two[1].highest, 0.3);
    EXPECT_EQ(plan(scene, {}).channels, 16);
    scene.fabrics[0].colours.specular_tint = step(0.2, 0.3); // the same colour
    EXPECT_EQ(dye_variables(scene).size(), 2u);
    scene.fabrics[0].colours.specular_tint = step(0.9, 1);
    EXPECT_THROW(dye_variables(scene), Error);
    EXPECT_THROW(render(scene, {.stop = {.samples_per_pixel = 1}}), Error);
    scene.open_dyes = {FabricIndex{99}};
    EXPECT_THROW(check_scene(scene), Error);
    scene.open_dyes.clear();
    EXPECT_EQ(plan(scene, {}).channels, 16);
    EXPECT_TRUE(plan(scene, {}).dyes.empty());
}

// The mean of a light group over the picture, of the dyes that are shown at a wavelength.
double mean_at(const SpectralImage &image, std::size_t group, double nm) {
    const std::vector<double> weights =
        image.depths ? DepthWeights(*image.depths).at_nm(nm) : BasisWeights(image.basis).at_nm(nm);
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (std::size_t k = 0; k < weights.size(); ++k)
                sum += weights[k] * static_cast<double>(image.pixel(group, x, y)[k]);
    return sum / (image.width * image.height);
}

TEST(DyeDepths, OneRenderShowsTheDyesOfMany) {
    const RenderSettings settings{.stop = {.samples_per_pixel = 256}, .channels = 8};
    Scene scene = test::folded_satin(24, 24);
    scene.open_dyes = {FabricIndex{0}};
    RenderResult open = render(scene, settings);
    ASSERT_TRUE(open.image.depths);
    scene.open_dyes.clear();
    for (const double dye : {0.0, 0.1, 0.45, 0.8}) {
        set_dye(*open.image.depths, "", Spectrum::constant(dye));
        scene.fabrics[0].colours.dye = Spectrum::constant(dye);
        const RenderResult fixed = render(scene, settings);
        for (std::size_t group = 0; group < 2; ++group)
            EXPECT_NEAR(mean_at(open.image, group, 550) / mean_at(fixed.image, group, 550), 1, 4e-3)
                << dye << ", group " << group;
        // Negative control: the next dye
        set_dye(*open.image.depths, "", Spectrum::constant(dye + 0.03));
        EXPECT_GT(std::abs(mean_at(open.image, 0, 550) / mean_at(fixed.image, 0, 550) - 1), 4e-3);
    }
}

TEST(DyeDepths, TwoColoursAreExactAtEveryWavelength) {
    const RenderSettings settings{.stop = {.samples_per_pixel = 256}, .channels = 8};
    Scene scene = test::folded_satin(24, 24);
    scene.fabrics[0].colours.dye = step(0.7, 0.1);
    scene.fabrics[1].colours.dye = step(0.2, 0.6);
    scene.open_dyes = {FabricIndex{0}};
    const RenderResult open = render(scene, settings);
    scene.open_dyes.clear();
    for (const double nm : {500.0, 600.0}) {
        Scene at = scene;
        for (std::size_t i = 0; i < 2; ++i)
            at.fabrics[i].colours.dye = Spectrum::constant(scene.fabrics[i].colours.dye.at(nm));
        const RenderResult fixed = render(at, settings);
        for (std::size_t group = 0; group < 2; ++group)
            EXPECT_NEAR(mean_at(open.image, group, nm) / mean_at(fixed.image, group, 550), 1, 4e-3)
                << nm << ", group " << group;
    }
}

} // namespace
} // namespace tsuya

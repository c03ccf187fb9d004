#include "tsuya/color/compare.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

std::vector<NamedLamp> lamps() {
    return {{"D65", lamp("D65")}, {"HP4", lamp("HP4")}, {"A", lamp("A")}};
}

// 20 pixels a row: crimson of rising brightness; the last row is empty.
SpectralImage crimson_ramp() {
    SpectralImage image = SpectralImage::make(20, 3, {.count = 16}, {"key"});
    const std::vector<float> dye_channels = project(dye("crimson"), image.basis);
    for (int y = 0; y < 2; ++y)
        for (int x = 0; x < 20; ++x)
            for (int k = 0; k < 16; ++k)
                image.pixel(0, x, y)[k] =
                    dye_channels[static_cast<std::size_t>(k)] * 0.05f * static_cast<float>(x + 1);
    return image;
}

TEST(Compare, AgreesWithPixelByPixel) {
    const SpectralImage image = crimson_ramp();
    const auto named = lamps();
    const auto found = compare_lamps(image, named);
    ASSERT_EQ(found.size(), 3u);
    std::size_t entry = 0;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = i + 1; j < 3; ++j, ++entry) {
            std::vector<double> all;
            for (int x = 0; x < 20; ++x) {
                glm::dvec3 lab[2];
                for (int side = 0; side < 2; ++side) {
                    const Spectrum &s = named[side == 0 ? i : j].spectrum;
                    Spectrum lit{{}, {}};
                    for (int k = 0; k < 16; ++k) {
                        lit.wavelength_nm.push_back(image.basis.centre_nm(k));
                        lit.value.push_back(image.pixel(0, x, 0)[k]);
                    }
                    const glm::dmat3 m =
                        adaptation_matrix(Adaptation::cat02, white_of(s), srgb_white());
                    lab[side] = lab_of(m * xyz_of(s, lit), srgb_white());
                }
                all.push_back(ciede2000(lab[0], lab[1]));
                all.push_back(all.back()); // the second row is the same
            }
            std::sort(all.begin(), all.end());
            double mean = 0;
            for (const double v : all)
                mean += v / 40;
            EXPECT_EQ(found[entry].first, named[i].name);
            EXPECT_EQ(found[entry].second, named[j].name);
            EXPECT_EQ(found[entry].pixels, 40u);
            EXPECT_NEAR(found[entry].mean, mean, 1e-3);
            EXPECT_NEAR(found[entry].p95, all[37], 1e-3);
            EXPECT_NEAR(found[entry].max, all[39], 1e-3);
            EXPECT_GT(found[entry].mean, 1);
        }
}

TEST(Compare, NeutralClothDoesNotChange) {
    SpectralImage image = SpectralImage::make(4, 4, {.count = 8}, {"key"});
    std::fill(image.transport.begin(), image.transport.end(), 0.4f);
    for (const Adaptation adapt : {Adaptation::cat02, Adaptation::bradford})
        for (const LampDifference &d : compare_lamps(image, lamps(), {.adapt = adapt}))
            EXPECT_LT(d.max, 1e-2) << d.second;
    for (const LampDifference &d : compare_lamps(image, lamps(), {.adapt = Adaptation::none}))
        EXPECT_GT(d.mean, 5) << d.second;
}

TEST(Compare, CountsCoveredFinitePixels) {
    SpectralImage image = crimson_ramp();
    image.pixel(0, 3, 0)[5] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(compare_lamps(image, lamps())[0].pixels, 39u);
    EXPECT_TRUE(std::isfinite(compare_lamps(image, lamps())[0].max));
    image.aovs.push_back(Image::make(20, 3, {"Y"}));
    image.aov_names.push_back("coverage");
    EXPECT_EQ(compare_lamps(image, lamps())[0].pixels, 0u);
    EXPECT_EQ(compare_lamps(image, lamps())[0].max, 0.0);
    *image.aovs[0].pixel(3, 0) = 1.0f; // not finite
    *image.aovs[0].pixel(4, 0) = 0.5f;
    *image.aovs[0].pixel(5, 0) = 0.4f;
    EXPECT_EQ(compare_lamps(image, lamps())[0].pixels, 1u);
    // The garment's counts before it, alpha after it
    image.aovs.push_back(image.aovs[0]);
    image.aov_names.push_back("garment");
    *image.aovs[1].pixel(7, 1) = 1.0f;
    EXPECT_EQ(compare_lamps(image, lamps())[0].pixels, 2u);
    image.aovs.clear();
    image.aov_names.clear();
    image.alpha = Image::make(20, 3, {"A"});
    image.alpha->data[30] = image.alpha->data[31] = image.alpha->data[32] = 0.7f;
    EXPECT_EQ(compare_lamps(image, lamps())[0].pixels, 3u);
}

// Half of a crimson pixel is as crimson as the whole.
TEST(Compare, TakesAlphaOutOfTheColours) {
    SpectralImage whole = crimson_ramp();
    whole.alpha = Image::make(20, 3, {"A"});
    std::fill(whole.alpha->data.begin(), whole.alpha->data.end(), 1.0f);
    SpectralImage half = whole;
    std::fill(half.alpha->data.begin(), half.alpha->data.end(), 0.5f);
    for (float &t : half.transport)
        t *= 0.5f;
    EXPECT_NEAR(compare_lamps(half, lamps())[0].mean, compare_lamps(whole, lamps())[0].mean, 1e-5);
}

TEST(Compare, RefusesFewOrRepeatedLamps) {
    const SpectralImage image = crimson_ramp();
    const std::vector<NamedLamp> one(1, lamps()[0]), twice(2, lamps()[0]);
    test::expect_problem([&] { compare_lamps(image, one); }, "lamps", "at least two");
    test::expect_problem([&] { compare_lamps(image, twice); }, "lamps.1", "named twice");
}

} // namespace
} // namespace tsuya

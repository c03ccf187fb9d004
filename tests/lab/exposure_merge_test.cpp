#include "tsuya/lab/exposure_merge.h"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tsuya/lab/patch_window.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kDarkCurrent = 0.8; // DN/s
const Sensor kSensor{.black = 512, .saturation = 15800, .e_per_dn = 2.5, .read_noise_e = 4};
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ExposedPixels exposed(const std::vector<double> &rates, double exposure_s) {
    ExposedPixels pixels{.exposure_s = exposure_s};
    for (const double rate : rates)
        pixels.dn.push_back(
            std::min(kSensor.black + (rate + kDarkCurrent) * exposure_s, kSensor.saturation));
    return pixels;
}

/// The same with photon and read-out noise, in whole numbers.
ExposedPixels noisy(const std::vector<double> &rates, double exposure_s, std::mt19937 &random) {
    ExposedPixels pixels{.exposure_s = exposure_s};
    std::normal_distribution<double> read(0, kSensor.read_noise_e);
    for (const double rate : rates) {
        std::poisson_distribution<long> electrons((rate + kDarkCurrent) * exposure_s *
                                                  kSensor.e_per_dn);
        const double dn = static_cast<double>(electrons(random)) + read(random);
        pixels.dn.push_back(
            std::min(std::round(kSensor.black + dn / kSensor.e_per_dn), kSensor.saturation));
    }
    return pixels;
}

DarkPixels dark_of(std::size_t pixels, double exposure_s) {
    return mean_of_dark(std::vector{exposed(std::vector<double>(pixels, 0.0), exposure_s)});
}

double mean(const std::vector<double> &values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(ExposureMerge, GivesTheRateAboveBlackAndDarkCurrent) {
    const std::vector<double> rates{0, 3, 100, 5000};
    const std::vector exposures{exposed(rates, 0.1), exposed(rates, 1), exposed(rates, 10)};
    const std::vector dark{dark_of(4, 0.1), dark_of(4, 1), dark_of(4, 10)};
    const PixelRates pixels = merge_exposures(exposures, dark, kSensor);
    for (std::size_t i = 0; i < rates.size(); ++i) {
        EXPECT_NEAR(pixels.rate[i], rates[i], 1e-9 * (1 + rates[i])) << i;
        EXPECT_FALSE(pixels.clipped[i]);
    }
    // Black alone leaves the dark current in.
    const PixelRates without = merge_exposures(exposures, std::vector<DarkPixels>(3), kSensor);
    EXPECT_NEAR(without.rate[1], 3 + kDarkCurrent, 1e-9);
}

TEST(ExposureMerge, TellsPixelsThatEveryExposureClips) {
    const std::vector<double> rates{10, 200000};
    const std::vector exposures{exposed(rates, 1), exposed(rates, 0.1)};
    const PixelRates pixels =
        merge_exposures(exposures, std::vector{dark_of(2, 1), dark_of(2, 0.1)}, kSensor);
    EXPECT_FALSE(pixels.clipped[0]);
    EXPECT_TRUE(pixels.clipped[1]);
    EXPECT_GT(pixels.rate[1], 100000) << "of the shortest exposure";
    const PatchMean patch = mean_of_patch(pixels, 2, 0, 0, 1, std::vector{1.0});
    EXPECT_EQ(patch.clipped, 0);
    EXPECT_EQ(mean_of_patch(pixels, 2, 1, 0, 1, std::vector{1.0}).clipped, 1);
}

// 30 electrons a pixel: the mean of many is not biased, and spreads as its variance says. Weights
// by the pixel's own noise, as the inverse variance of each exposure, would be.
TEST(ExposureMerge, IsNotBiasedWhereLightIsScarce) {
    std::mt19937 random(7);
    const std::vector<double> rates(200000, 12.0 / 1.5); // DN/s: 30 electrons over both exposures
    const std::vector exposures{noisy(rates, 0.5, random), noisy(rates, 1, random)};
    const std::vector dark{dark_of(rates.size(), 0.5), dark_of(rates.size(), 1)};
    const PixelRates pixels = merge_exposures(exposures, dark, kSensor);
    const double spread = std::sqrt(mean(pixels.variance) / static_cast<double>(rates.size()));
    EXPECT_NEAR(mean(pixels.rate), rates[0], 4 * spread);

    double squares = 0;
    for (const double rate : pixels.rate)
        squares += (rate - rates[0]) * (rate - rates[0]);
    // The dark frames here have no noise, and the variance counts what one of them would have.
    const double dark_part = 2 * (16 / 6.25 + 1.0 / 12) + 1.5 * kDarkCurrent / 2.5;
    EXPECT_NEAR(squares / static_cast<double>(rates.size()),
                mean(pixels.variance) - dark_part / 2.25, 0.01 * mean(pixels.variance));

    std::vector<double> weighted;
    for (std::size_t i = 0; i < rates.size(); ++i) {
        double sum = 0, weights = 0;
        for (std::size_t k = 0; k < 2; ++k) {
            const double t = exposures[k].exposure_s, dn = exposures[k].dn[i] - dark[k].dn[i];
            const double weight = t * t / (std::max(dn, 0.0) / 2.5 + 16 / 6.25);
            sum += weight * dn / t;
            weights += weight;
        }
        weighted.push_back(sum / weights);
    }
    EXPECT_LT(mean(weighted), 0.985 * rates[0]) << "the negative control";
}

// A glittering cloth: log-normal pixels of contrast .5, of which the long exposure clips 5 %.
TEST(ExposureMerge, NoClippedPixelIsDropped) {
    std::mt19937 random(3);
    const double sigma = std::sqrt(std::log(1.25));
    std::lognormal_distribution<double> texture(-sigma * sigma / 2, sigma);
    std::vector<double> rates(40000);
    for (double &rate : rates)
        rate = 6900 * texture(random);
    const std::vector exposures{exposed(rates, 1), exposed(rates, 0.05)};
    const std::vector dark{dark_of(rates.size(), 1), dark_of(rates.size(), 0.05)};
    const PixelRates pixels = merge_exposures(exposures, dark, kSensor);
    EXPECT_NEAR(mean(pixels.rate) / mean(rates), 1, 1e-9);

    std::vector<double> kept;
    for (const double dn : exposures[0].dn)
        if (dn <= kUsableShare * kSensor.saturation)
            kept.push_back(dn - dark[0].dn[0]);
    EXPECT_NEAR(static_cast<double>(kept.size()) / 40000, 0.95, 0.02);
    EXPECT_LT(mean(kept) / mean(rates), 0.95) << "the negative control";
}

TEST(ExposureMerge, ColoursOfASensorStayApart) {
    const ExposedPixels red{.exposure_s = 1, .dn = {612, kNan, 712, kNan}};
    const PixelRates pixels =
        merge_exposures(std::vector{red}, std::vector<DarkPixels>(1), kSensor);
    EXPECT_TRUE(std::isnan(pixels.rate[1]));
    const PatchMean patch = mean_of_patch(pixels, 2, 0, 0, 2, even_window(2).weights);
    EXPECT_DOUBLE_EQ(patch.rate, 150);
    EXPECT_EQ(patch.clipped, 0);
    EXPECT_THROW(mean_of_patch(pixels, 2, 1, 0, 1, std::vector{1.0}), Error);
}

TEST(ExposureMerge, RefusesFramesThatDoNotFit) {
    const std::vector exposures{exposed({1, 2}, 1), exposed({1, 2, 3}, 2)};
    EXPECT_THROW(merge_exposures(exposures, std::vector<DarkPixels>(2), kSensor), Error);
    EXPECT_THROW(merge_exposures({}, {}, kSensor), Error);
    EXPECT_THROW(mean_of_dark({}), Error);
    EXPECT_THROW(mean_of_dark(exposures), Error);
}

TEST(PatchMean, SharpnessSeesStepsAndNotNoise) {
    std::mt19937 random(5);
    std::vector<double> flat(256, 400), stripes(256);
    for (std::size_t i = 0; i < stripes.size(); ++i)
        stripes[i] = i % 2 == 0 ? 300 : 500;
    const auto sharpness = [&](const std::vector<double> &rates) {
        const PixelRates pixels = merge_exposures(std::vector{noisy(rates, 1, random)},
                                                  std::vector<DarkPixels>(1), kSensor);
        return mean_of_patch(pixels, 16, 0, 0, 16, even_window(16).weights).sharpness;
    };
    EXPECT_NEAR(sharpness(stripes), 0.25, 0.01); // (200 / 400)^2
    EXPECT_NEAR(sharpness(flat), 0, 5e-4);
}

} // namespace
} // namespace tsuya::lab

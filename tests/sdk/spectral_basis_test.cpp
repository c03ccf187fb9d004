// Channels over wavelengths: their functions, and spectra in them.

#include "tsuya/sdk/spectral_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

#include <gtest/gtest.h>

namespace tsuya {
namespace {

TEST(SpectralBasis, HatsSumToOne) {
    for (const int count : {1, 2, 3, 8, 16, 31}) {
        const SpectralBasis basis{.count = count};
        const BasisWeights weights(basis);
        for (double nm = 350; nm < 800; nm += 0.7) {
            double sum = 0;
            for (const double w : weights.at_nm(nm)) {
                EXPECT_GE(w, 0);
                EXPECT_LE(w, 1);
                sum += w;
            }
            EXPECT_NEAR(sum, 1, 1e-12) << count << " at " << nm;
        }
        for (int k = 0; k < count; ++k)
            EXPECT_NEAR(weights.at_nm(basis.centre_nm(k))[static_cast<std::size_t>(k)], 1, 1e-12);
    }
}

TEST(SpectralBasis, ConstantsAreProjectedExactly) {
    for (const int count : {1, 2, 16}) {
        const SpectralBasis basis{.count = count};
        for (const float c : project(Spectrum::constant(0.37), basis))
            EXPECT_EQ(c, 0.37f);
        for (const float c : project({{300, 500, 900}, {0.37, 0.37, 0.37}}, basis))
            EXPECT_EQ(c, 0.37f);
    }
}

TEST(SpectralBasis, ResidualIsOrthogonalToEveryHat) {
    const SpectralBasis basis;
    const Spectrum s{{400, 460, 475, 530, 610, 700}, {0.3, 0.5, 0.8, 0.4, 0.6, 0.5}};
    const std::vector<float> c = project(s, basis);
    const BasisWeights hats(basis);
    double largest = 0;
    for (std::size_t k = 0; k < c.size(); ++k) {
        double product = 0;
        for (double nm = 400; nm <= 700; ++nm) {
            const std::vector<double> weights = hats.at_nm(nm);
            double fit = 0;
            for (std::size_t j = 0; j < c.size(); ++j)
                fit += static_cast<double>(c[j]) * weights[j];
            product += (fit - s.at(nm)) * weights[k];
            largest = std::max(largest, std::abs(fit - s.at(nm)));
        }
        EXPECT_NEAR(product, 0, 1e-4);
    }
    EXPECT_GT(largest, 1e-3) << "nothing left to be orthogonal";
}

TEST(SpectralBasis, ProjectionIsNeverNegative) {
    const std::vector<float> c = project({{400, 500, 501, 700}, {0, 0, 1, 1}}, SpectralBasis{});
    EXPECT_GE(*std::min_element(c.begin(), c.end()), 0);
}

TEST(SpectralBasis, SamplesAreLinearBetweenNodes) {
    const SpectralBasis basis = SpectralBasis::samples_at({450, 520, 599.5, 700});
    EXPECT_TRUE(basis.is_valid());
    EXPECT_FALSE(SpectralBasis::samples_at({450, 450}).is_valid());
    EXPECT_FALSE(SpectralBasis::samples_at({}).is_valid());
    SpectralBasis one = SpectralBasis::samples_at({550});
    EXPECT_TRUE(one.is_valid());
    one.kind = BasisKind::fitted;
    EXPECT_FALSE(one.is_valid());
    const Spectrum s{{450, 520, 599.5, 700}, {0.3, 0.9, 0.1, 0.4}};
    const std::vector<float> c = project(s, basis);
    const BasisWeights weights(basis);
    for (double nm = 380; nm < 750; nm += 3.3) {
        const std::vector<double> at = weights.at_nm(nm);
        EXPECT_NEAR(std::inner_product(c.begin(), c.end(), at.begin(), 0.0), s.at(nm), 1e-7) << nm;
    }
}

Spectrum at_every_nm(const std::function<double(double)> &value) {
    Spectrum s{{}, {}};
    for (int nm = 360; nm <= 830; ++nm) {
        s.wavelength_nm.push_back(nm);
        s.value.push_back(value(nm));
    }
    return s;
}

// The spectrum that follows from channels has these channels; weights sum to 1.
TEST(SpectralBasis, FittedSpectraHaveTheirChannels) {
    // With a twentieth more than the largest weight that was measured, or less
    for (const auto &[count, most] : {std::pair{2, 1.18}, {8, 2.18}, {16, 8.0}, {32, 2.93}}) {
        const SpectralBasis basis = SpectralBasis::of_renders(count);
        ASSERT_TRUE(basis.is_valid());
        EXPECT_EQ(basis.count, count);
        EXPECT_GT(basis.centre_nm(0), 380);
        EXPECT_LT(basis.centre_nm(count - 1), 730);
        const BasisWeights weights(basis);
        double largest = 0;
        std::vector<float> channels;
        for (int k = 0; k < count; ++k)
            channels.push_back(0.5f + 0.4f * static_cast<float>(k % 3 - 1));
        const Spectrum follows = at_every_nm([&](double nm) {
            const std::vector<double> at = weights.at_nm(nm);
            EXPECT_NEAR(std::accumulate(at.begin(), at.end(), 0.0), 1, 1e-9) << nm;
            largest = std::max(largest, *std::max_element(at.begin(), at.end()));
            return std::inner_product(channels.begin(), channels.end(), at.begin(), 0.0);
        });
        EXPECT_LT(largest, most) << count; // no wild prediction beyond the nodes
        const std::vector<float> again = project(follows, basis);
        for (std::size_t k = 0; k < again.size(); ++k)
            EXPECT_NEAR(again[k], channels[k], 5e-3) << count << " " << k; // linear from nm to nm
        for (const float c : project(Spectrum::constant(0.37), basis))
            EXPECT_EQ(c, 0.37f);
    }
}

// A band as dyes have it, between the nodes.
TEST(SpectralBasis, FittedFollowsABandMoreCloselyThanHats) {
    const Spectrum band = at_every_nm([](double nm) {
        const double x = (nm - 548) / 30;
        return 0.8 - 0.7 * std::exp(-0.5 * x * x);
    });
    const auto worst = [&](const SpectralBasis &basis) {
        const BasisWeights weights(basis);
        const std::vector<float> c = project(band, basis);
        double most = 0;
        for (double nm = 420; nm <= 690; ++nm) {
            const std::vector<double> at = weights.at_nm(nm);
            const double fit = std::inner_product(c.begin(), c.end(), at.begin(), 0.0);
            most = std::max(most, std::abs(fit - band.at(nm)));
        }
        return most;
    };
    EXPECT_LT(worst(SpectralBasis::of_renders(16)), 0.5 * worst({.count = 16}));
    EXPECT_LT(worst(SpectralBasis::of_renders(16)), 0.01);
}

} // namespace
} // namespace tsuya

// The fitted channels of renders against sums at 1 nm, on reflectances that they were not fitted
// to: the 99 measured samples of [CIE224], the named dyes, and random smooth ones.

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tables.h"
#include "tsuya/color/channel_error.h"
#include "tsuya/color/difference.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/relight.h"

namespace tsuya {
namespace {

const std::vector<std::string> kSixLamps{"D65", "A", "FL2", "FL11", "HP4", "LED-B3"};

std::vector<Spectrum> measured() {
    std::vector<Spectrum> all;
    for (const auto &sample : tables::kEvaluationSamples) {
        Spectrum s{{}, {}};
        for (int i = 0; i < tables::kLampSamples; ++i) {
            s.wavelength_nm.push_back(tables::kLampFirstNm + tables::kLampStepNm * i);
            s.value.push_back(static_cast<double>(sample[i]));
        }
        all.push_back(std::move(s));
    }
    return all;
}

std::vector<Spectrum> dyes() {
    std::vector<Spectrum> all;
    for (const std::string &name : dye_names())
        all.push_back(dye(name));
    return all;
}

struct Errors {
    double mean = 0, p99 = 0;
};

// CIEDE2000 over the reflectances, as many random products of two, and six lamps: products of
// channels, as light has that meets both cloths.
Errors errors_of(const std::vector<Spectrum> &spectra, const SpectralBasis &basis) {
    std::mt19937 random(11);
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (std::size_t i = 0; i < spectra.size(); ++i)
        pairs.emplace_back(random() % spectra.size(), random() % spectra.size());
    std::vector<std::vector<float>> channels;
    for (const Spectrum &s : spectra)
        channels.push_back(project(s, basis));
    std::vector<double> errors;
    for (const std::string &name : kSixLamps) {
        const Spectrum light = lamp(name);
        const glm::dvec3 white = white_of(light);
        const std::vector<glm::dvec3> matrix = lamp_matrix(light, basis);
        const std::vector<ColorWeight> weights = color_weights(light);
        const auto add = [&](auto &&channel, auto &&reflectance) {
            glm::dvec3 shown(0), exact(0);
            for (std::size_t k = 0; k < matrix.size(); ++k)
                shown += static_cast<double>(channel(k)) * matrix[k];
            for (const ColorWeight &weight : weights)
                exact += reflectance(weight.wavelength_nm) * weight.xyz;
            errors.push_back(ciede2000(lab_of(shown, white), lab_of(exact, white)));
        };
        for (std::size_t i = 0; i < spectra.size(); ++i) {
            const auto [a, b] = pairs[i];
            add([&](std::size_t k) { return channels[i][k]; },
                [&](double nm) { return spectra[i].at(nm); });
            add([&, a = a, b = b](std::size_t k) { return channels[a][k] * channels[b][k]; },
                [&, a = a, b = b](double nm) { return spectra[a].at(nm) * spectra[b].at(nm); });
        }
    }
    std::sort(errors.begin(), errors.end());
    Errors result{.p99 = errors[errors.size() * 99 / 100]};
    for (const double e : errors)
        result.mean += e / static_cast<double>(errors.size());
    return result;
}

void record(const std::string &of, int channels, const Errors &errors) {
    testing::Test::RecordProperty(of + " " + std::to_string(channels),
                                  std::to_string(errors.mean) + " " + std::to_string(errors.p99));
}

struct Bound {
    int channels;
    double mean, p99;
};

// The bounds are about a twentieth above what was measured; hats of as many channels are beyond.
TEST(ChannelAccuracy, MeasuredReflectancesAreWithinTheBounds) {
    const std::vector<Spectrum> spectra = measured();
    for (const Bound &bound : {Bound{8, 0.37, 2.4}, {16, 0.033, 0.15}, {32, 0.0115, 0.058}}) {
        const Errors fitted = errors_of(spectra, SpectralBasis::of_renders(bound.channels));
        const Errors hats = errors_of(spectra, {.count = bound.channels});
        record("measured", bound.channels, fitted);
        record("measured in hats", bound.channels, hats);
        EXPECT_LT(fitted.mean, bound.mean) << bound.channels;
        EXPECT_LT(fitted.p99, bound.p99) << bound.channels;
        EXPECT_LT(fitted.mean, 0.8 * hats.mean) << bound.channels;
        EXPECT_GT(hats.mean, bound.mean) << bound.channels; // negative control
        EXPECT_GT(hats.p99, bound.p99) << bound.channels;
    }
}

TEST(ChannelAccuracy, NamedDyesAreWithinTheBounds) {
    const std::vector<Spectrum> spectra = dyes();
    for (const Bound &bound : {Bound{8, 0.17, 1.2}, {16, 0.020, 0.16}, {32, 0.0063, 0.055}}) {
        const Errors fitted = errors_of(spectra, SpectralBasis::of_renders(bound.channels));
        record("dyes", bound.channels, fitted);
        EXPECT_LT(fitted.mean, bound.mean) << bound.channels;
        EXPECT_LT(fitted.p99, bound.p99) << bound.channels;
    }
}

TEST(ChannelAccuracy, SharpEdgesHaveASmallerMeanErrorThanInHats) {
    std::vector<Spectrum> edges;
    for (int nm = 420; nm <= 680; nm += 5) {
        edges.push_back({{nm + 0.0, nm + 1.0}, {0.05, 0.8}});
        edges.push_back({{nm + 0.0, nm + 1.0}, {0.8, 0.05}});
    }
    for (const int channels : {16, 32}) {
        const Errors fitted = errors_of(edges, SpectralBasis::of_renders(channels));
        const Errors hats = errors_of(edges, {.count = channels});
        record("edges", channels, fitted);
        record("edges in hats", channels, hats);
        EXPECT_LT(fitted.mean, hats.mean) << channels;
    }
}

// The least that channels between 0 and 1 can give, of what a white gives: how far below 0 a
// spectrum of the sharpest edges could come.
TEST(ChannelAccuracy, NegativeWeightsAreBounded) {
    for (const auto &[channels, share] :
         {std::pair{8, 0.2}, std::pair{16, 0.03}, std::pair{32, 0.06}}) {
        const SpectralBasis basis = SpectralBasis::of_renders(channels);
        for (const std::string &name : lamp_names()) {
            glm::dvec3 least(0), white(0);
            for (const glm::dvec3 &xyz : lamp_matrix(lamp(name), basis))
                for (int c = 0; c < 3; ++c) {
                    least[c] += std::min(0.0, xyz[c]);
                    white[c] += xyz[c];
                }
            for (int c = 0; c < 3; ++c)
                EXPECT_GT(least[c], -share * white[c]) << channels << " " << name << " " << c;
        }
    }
}

// An edge of a nanometre, of which no 16 samples can know.
TEST(ChannelAccuracy, SharpEdgesAreTold) {
    const Spectrum edge{{580, 581}, {0.04, 0.8}};
    EXPECT_GT(channel_error(edge, SpectralBasis::of_renders(16)), 1);
    EXPECT_LT(channel_error(dye("crimson"), SpectralBasis::of_renders(16)), 0.3);
    EXPECT_LT(channel_error(Spectrum::constant(0.3), SpectralBasis::of_renders(8)), 1e-3);
}

} // namespace
} // namespace tsuya

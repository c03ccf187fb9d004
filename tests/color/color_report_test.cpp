#include "tsuya/color/color_report.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/adaptation.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"

namespace tsuya {
namespace {

std::vector<Lighting> lightings() {
    std::vector<Lighting> all;
    for (const char *name : {"D65", "A", "FL11"})
        all.push_back(lighting_of({.name = name, .spectrum = lamp(name)}));
    return all;
}

/// Rows of a dye whose brightness rises from 0.05 to 1 over 20 pixels.
SpectralImage ramp_of(const std::string &dye_name) {
    SpectralImage image = SpectralImage::make(20, 1, {.count = 16}, {"key"});
    const std::vector<float> channels = project(dye(dye_name), image.basis);
    for (int x = 0; x < 20; ++x)
        for (int k = 0; k < 16; ++k)
            image.pixel(0, x, 0)[k] =
                channels[static_cast<std::size_t>(k)] * 0.05f * static_cast<float>(x + 1);
    return image;
}

/// What the transport reflects at a pixel, as a spectrum.
Spectrum spectrum_of(const SpectralImage &image, int x, double scale = 1) {
    Spectrum spectrum{{}, {}};
    for (int k = 0; k < image.basis.count; ++k) {
        spectrum.wavelength_nm.push_back(image.basis.centre_nm(k));
        spectrum.value.push_back(scale * image.pixel(0, x, 0)[k]);
    }
    return spectrum;
}

TEST(ColorReport, AgreesWithSpectraOneByOne) {
    ColorReporter reporter;
    reporter.add({.name = "a", .dye = "rose", .lightings = lightings()}, ramp_of("rose"));
    const ColorReport report = reporter.report();
    ASSERT_EQ(report.parts.size(), 1u);
    const PartReport &part = report.parts[0];
    EXPECT_EQ(part.picture, "a");
    EXPECT_EQ(part.dye, "rose");
    EXPECT_EQ(part.kind, "garment");
    EXPECT_EQ(part.pixels, 20u);
    ASSERT_EQ(part.observed.size(), 2u);
    EXPECT_EQ(part.observed[0].observer, Observer::cie1964);
    const Spectrum d65 = lamp("D65"), a = lamp("A");
    // The mean of the ramp is 0.525 of its last pixel; its 5th percentile is the first of 20.
    const SpectralImage image = ramp_of("rose");
    for (const ObservedPart &observed : part.observed) {
        const Observer eye = observed.observer;
        const glm::dvec3 white = white_of(d65, eye), warm = white_of(a, eye);
        const glm::dvec3 day = xyz_of(d65, spectrum_of(image, 19, 0.525), eye),
                         night = xyz_of(a, spectrum_of(image, 19, 0.525), eye);
        const glm::dvec3 lab = lab_of(day, white);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(observed.colors[0].lab[c], lab[c], 1e-3);
        EXPECT_NEAR(observed.colors[0].over_angle[0].p5,
                    lab_of(xyz_of(d65, spectrum_of(image, 0), eye), white).x, 1e-3);
        EXPECT_NEAR(observed.colors[0].over_angle[0].p50,
                    lab_of(xyz_of(d65, spectrum_of(image, 9), eye), white).x, 1e-3);
        EXPECT_NEAR(observed.colors[0].over_angle[0].p95,
                    lab_of(xyz_of(d65, spectrum_of(image, 18), eye), white).x, 1e-3);
        const PartChange &change = observed.changes[0];
        EXPECT_EQ(change.reference, "D65");
        EXPECT_EQ(change.test, "A");
        EXPECT_NEAR(change.inconstancy.value(), color_inconstancy(day, white, night, warm), 1e-3);
        const glm::dmat3 adapt = adaptation_matrix(Adaptation::cat02, warm, white);
        EXPECT_NEAR(change.ciede2000.value(), ciede2000(lab, lab_of(adapt * night, white)), 1e-3);
        EXPECT_GT(change.ciede2000.value(), 0.5);
        EXPECT_LT(change.ciede2000_over_angle.p5, change.ciede2000_over_angle.p95);
        EXPECT_GT(change.inconstancy_over_angle.p50, 0.5);
    }
    EXPECT_TRUE(report.pairs.empty());
}

TEST(ColorReport, MatchesTwoCloths) {
    ColorReporter reporter({.observers = {Observer::cie1964}});
    reporter.add({.name = "a", .lightings = lightings()}, ramp_of("rose"));
    reporter.add({.name = "b", .lightings = lightings()}, ramp_of("madder"));
    const ColorReport report = reporter.report();
    ASSERT_EQ(report.pairs.size(), 1u);
    const PairReport &pair = report.pairs[0];
    EXPECT_EQ(pair.first, 0u);
    EXPECT_EQ(pair.second, 1u);
    ASSERT_EQ(pair.matches.size(), 3u);
    ASSERT_EQ(pair.metamerism.size(), 2u);
    const glm::dvec3 first = report.parts[0].observed[0].colors[1].lab,
                     second = report.parts[1].observed[0].colors[1].lab;
    EXPECT_NEAR(pair.matches[1].ciede2000, ciede2000(first, second), 1e-3);
    EXPECT_NEAR(pair.matches[1].cmc, cmc(first, second), 1e-3);
    const Spectrum a = spectrum_of(ramp_of("rose"), 19, 0.525),
                   b = spectrum_of(ramp_of("madder"), 19, 0.525);
    const auto index = [&](MetamerismCorrection correction) {
        return metamerism_index(a, b, lamp("D65"), lamp("A"),
                                {.observer = Observer::cie1964, .correction = correction});
    };
    EXPECT_NEAR(pair.metamerism[0].multiplicative.value(),
                index(MetamerismCorrection::multiplicative), 1e-3);
    EXPECT_NEAR(pair.metamerism[0].additive, index(MetamerismCorrection::additive), 1e-3);
    EXPECT_NEAR(pair.metamerism[0].spectral.value(), index(MetamerismCorrection::spectral), 1e-3);
}

TEST(ColorReport, AlphaAndExposureAreNoColour) {
    SpectralImage half = ramp_of("rose");
    for (float &t : half.transport)
        t *= 0.5f;
    const auto lightness = [](const SpectralImage &image, double stops) {
        ColorReporter reporter({.observers = {Observer::cie1931}, .exposure_stops = stops});
        reporter.add({.lightings = lightings()}, image);
        EXPECT_EQ(reporter.report().exposure_stops, stops);
        return reporter.report().parts[0].observed[0].colors[0].lab.x;
    };
    EXPECT_NEAR(lightness(half, 1), lightness(ramp_of("rose"), 0), 1e-3);
    half.alpha = Image::make(20, 1, {"A"});
    std::fill(half.alpha->data.begin(), half.alpha->data.end(), 0.5f);
    EXPECT_NEAR(lightness(half, 0), lightness(ramp_of("rose"), 0), 1e-3);
}

TEST(ColorReport, ALineHasColoursAndNoInconstancy) {
    const Spectrum line{{430, 436, 442}, {0, 1, 0}};
    std::vector<Lighting> lights = lightings();
    lights[1] = lighting_of({.name = "violet", .spectrum = line});
    ColorReporter reporter;
    reporter.add({.lightings = lights}, ramp_of("rose"));
    const ObservedPart part = reporter.report().parts[0].observed[0];
    EXPECT_TRUE(std::isfinite(part.colors[1].lab.x));
    EXPECT_FALSE(part.changes[0].inconstancy);
    EXPECT_TRUE(part.changes[1].inconstancy);
}

TEST(ColorReport, RefusesOtherLamps) {
    ColorReporter reporter;
    test::expect_problem([&] { reporter.add({}, ramp_of("rose")); }, "lamps", "no lamp");
    reporter.add({.lightings = lightings()}, ramp_of("rose"));
    std::vector<Lighting> two = lightings();
    two.pop_back();
    test::expect_problem([&] { reporter.add({.lightings = two}, ramp_of("rose")); }, "lamps",
                         "not those before");
}

} // namespace
} // namespace tsuya

#include "tsuya/color/shown_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

SpectralImage some_light() {
    SpectralImage image = SpectralImage::make(31, 17, {.count = 16}, {"key", "fill"});
    std::mt19937 random(5);
    std::uniform_real_distribution<float> uniform(0.0f, 1.0f);
    for (float &t : image.transport)
        t = 2 * std::pow(uniform(random), 3.0f);
    return image;
}

Lighting mixed() {
    return {"mixed",
            "",
            {{.name = "A", .spectrum = lamp("A"), .factor = 0.6},
             {.name = "D65", .spectrum = lamp("D65")}}};
}

TEST(ShownPicture, IsThePictureInThreePasses) {
    const SpectralImage image = some_light();
    for (const Lighting &lighting :
         {mixed(), lighting_of({.name = "FL11", .spectrum = lamp("FL11")})})
        for (const char *view : {"Plain", "Soft"})
            for (const Adaptation adapt : {Adaptation::none, Adaptation::cat02}) {
                const DisplayOptions look{.adapt = adapt, .view = view, .exposure_stops = 0.5};
                const Image shown = shown_picture(image, lighting, look);
                const Image passes =
                    display(relight(image, lighting), adopted_white(image, lighting), look);
                ASSERT_EQ(shown.channels, passes.channels);
                for (std::size_t i = 0; i < shown.data.size(); ++i)
                    ASSERT_NEAR(shown.data[i], passes.data[i], 2e-5) << view << i;
            }
}

TEST(ShownPicture, AlphaIsNotInTheColours) {
    SpectralImage image = some_light();
    const Image whole = shown_picture(image, mixed());
    image.alpha = Image::make(31, 17, {"A"});
    std::fill(image.alpha->data.begin(), image.alpha->data.end(), 0.25f);
    for (float &t : image.transport)
        t *= 0.25f;
    image.alpha->data[3] = 0;
    const Image shown = shown_picture(image, mixed());
    ASSERT_EQ(shown.channels, (std::vector<std::string>{"R", "G", "B", "A"}));
    EXPECT_EQ(shown.pixel(3, 0)[1], 0.0f);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(shown.pixel(7, 5)[c], whole.pixel(7, 5)[c], 1e-5);
    EXPECT_EQ(shown.pixel(7, 5)[3], 0.25f);
    // Linear light has it in, as EXR does.
    EXPECT_NEAR(linear_picture(image, mixed()).pixel(7, 5)[1],
                0.25 * srgb_decode(whole.pixel(7, 5)[1]), 1e-4);
}

TEST(ShownPicture, WhatIsNotFiniteStaysVisible) {
    SpectralImage image = some_light();
    image.pixel(1, 4, 2)[7] = std::numeric_limits<float>::infinity();
    const Image shown = shown_picture(image, mixed());
    EXPECT_TRUE(std::isnan(shown.pixel(4, 2)[0]));
    EXPECT_TRUE(std::isfinite(shown.pixel(5, 2)[0]));
}

// A weak group of another lamp does not decide what the eye is used to.
TEST(AdoptedWhite, IsThatOfTheLight) {
    SpectralImage image = some_light();
    std::fill(image.transport.begin(), image.transport.end(), 0.4f);
    const glm::dvec3 a = white_of(lamp("A")), d65 = white_of(lamp("D65"));
    Lighting lighting = mixed();
    lighting.lamps[0].factor = 1e-6;
    const glm::dvec3 white = adopted_white(image, lighting);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(white[c], d65[c], 1e-5);
    lighting.lamps[0].factor = 3; // three quarters of the light
    const glm::dvec3 warm = adopted_white(image, lighting);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(warm[c], 0.75 * a[c] + 0.25 * d65[c], 1e-9);
    // What lies beyond the garment does not count
    image.aovs = {Image::make(31, 17, {"Y"})};
    image.aov_names = {"garment"};
    *image.aovs[0].pixel(3, 3) = 1;
    std::fill_n(image.pixel(0, 3, 3), 16, 0.0f);
    EXPECT_NEAR(adopted_white(image, lighting).z, d65.z, 1e-9);
    std::fill(image.transport.begin(), image.transport.end(), 0.0f);
    EXPECT_NEAR(adopted_white(image, lighting).z, (a.z + d65.z) / 2, 1e-9);
    lighting.lamps.push_back(lighting.lamps[0]);
    test::expect_problem([&] { adopted_white(image, lighting); }, "lamps",
                         "3 lamps for 2 light groups");
}

// The lamp of a picture of radiance is in it: no other may be asked for.
TEST(ShownPicture, RadianceKeepsItsLamp) {
    SpectralImage image = some_light();
    image.emissive = true;
    const Lighting equal = lighting_of({.name = "E", .spectrum = lamp("E")});
    EXPECT_EQ(shown_picture(image, equal).data, shown_picture(some_light(), equal).data);
    EXPECT_NEAR(adopted_white(image, equal).x, 1, 1e-3);
    for (const Lighting &lighting : {mixed(), lighting_of({.name = "A", .spectrum = lamp("A")})}) {
        const auto refused = [](const auto &action) {
            test::expect_problem(action, "lamps", "the picture is radiance");
        };
        refused([&] { shown_picture(image, lighting); });
        refused([&] { shown_picture(image, lighting, {.display = "Rec.2020"}); });
        refused([&] { linear_picture(image, lighting); });
        refused([&] { linear_picture(image, lighting, {.adapt = Adaptation::cat02}); });
        refused([&] { share_out_of_gamut(image, lighting); });
        refused([&] { adopted_white(image, lighting); });
        refused([&] { check_lighting(image, lighting); });
    }
}

TEST(ShownPicture, RefusesADegreeWithoutAdaptationToo) {
    const SpectralImage image = some_light();
    test::expect_problem([&] { shown_picture(image, mixed(), {.degree = 1.5}); }, "degree", "1.5");
}

TEST(OutOfGamut, CountsWhatTheTriangleLacks) {
    SpectralImage image = SpectralImage::make(4, 1, {.count = 16}, {"key"});
    const Lighting day = lighting_of({.name = "D65", .spectrum = lamp("D65")});
    for (int x = 0; x < 4; ++x)
        std::fill_n(image.pixel(0, x, 0), 16, 0.5f);
    EXPECT_EQ(share_out_of_gamut(image, day), 0.0);
    std::fill_n(image.pixel(0, 2, 0), 16, 0.0f);
    image.pixel(0, 2, 0)[6] = 1; // green of 520 nm alone
    EXPECT_EQ(share_out_of_gamut(image, day), 0.25);
}

} // namespace
} // namespace tsuya

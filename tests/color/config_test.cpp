#include "tsuya/color/config.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"

namespace tsuya {
namespace {

std::vector<LampWhite> lamps() {
    std::vector<LampWhite> all;
    for (const char *name : {"D65", "HP4", "A", "LED-B3"})
        all.push_back({name, white_of(lamp(name))});
    return all;
}

// Colours inside and outside the display, dark and bright.
Image some_xyz() {
    Image xyz = Image::make(23, 17, {"X", "Y", "Z"});
    for (int y = 0; y < xyz.height; ++y)
        for (int x = 0; x < xyz.width; ++x) {
            const float level = std::exp2(static_cast<float>(y) - 12.0f);
            const float turn = static_cast<float>(x) * 0.27f;
            xyz.pixel(x, y)[0] = level * (1.0f + 0.5f * std::sin(turn));
            xyz.pixel(x, y)[1] = level;
            xyz.pixel(x, y)[2] = level * (1.0f + 0.8f * std::cos(1.7f * turn));
        }
    return xyz;
}

glm::dvec3 direct(const float *in, const glm::dvec3 &white, const DisplayOptions &options) {
    const glm::dvec3 xyz = std::exp2(options.exposure_stops) * glm::dvec3(in[0], in[1], in[2]);
    glm::dvec3 rgb =
        srgb_from_xyz() * (adaptation_matrix(options.adapt, white, srgb_white()) * xyz);
    for (int c = 0; c < 3; ++c)
        rgb[c] = std::clamp(srgb_encode(rgb[c]), 0.0, 1.0);
    return rgb;
}

TEST(Config, PlainAgreesWithDirectComputation) {
    const DisplayConfig config(lamps());
    const Image xyz = some_xyz();
    for (const LampWhite &lit : lamps())
        for (const Adaptation adapt : {Adaptation::none, Adaptation::bradford, Adaptation::cat02})
            for (const double stops : {0.0, -1.5, 2.0}) {
                const DisplayOptions options{.adapt = adapt, .exposure_stops = stops};
                const Image rgb = config.display(xyz, lit.name, options);
                ASSERT_EQ(rgb.channels, (std::vector<std::string>{"R", "G", "B"}));
                double worst = 0;
                for (int y = 0; y < xyz.height; ++y)
                    for (int x = 0; x < xyz.width; ++x) {
                        const glm::dvec3 expected = direct(xyz.pixel(x, y), lit.white_xyz, options);
                        for (int c = 0; c < 3; ++c)
                            worst = std::max(worst, std::abs(rgb.pixel(x, y)[c] - expected[c]));
                    }
                EXPECT_LT(worst, 1e-4) << lit.name << ' ' << to_string(adapt);
            }
}

TEST(Config, AdaptedWhiteIsNeutral) {
    for (const LampWhite &lit : lamps()) {
        const glm::dvec3 grey = 0.5 * lit.white_xyz;
        const Image xyz{
            1,
            1,
            {"X", "Y", "Z"},
            {static_cast<float>(grey.x), static_cast<float>(grey.y), static_cast<float>(grey.z)}};
        for (const Adaptation adapt : {Adaptation::bradford, Adaptation::cat02})
            for (const std::string &view : view_names()) {
                const Image rgb = display(xyz, lit.white_xyz, {.adapt = adapt, .view = view});
                EXPECT_NEAR(rgb.data[0], rgb.data[1], 1e-5) << lit.name << view;
                EXPECT_NEAR(rgb.data[2], rgb.data[1], 1e-5) << lit.name << view;
            }
        // Without adaptation only daylight is neutral.
        const Image seen = display(xyz, lit.white_xyz);
        if (lit.name != "D65") {
            EXPECT_GT(std::abs(seen.data[0] - seen.data[2]), 0.05) << lit.name;
        }
    }
}

Image grey_ramp(int steps) {
    Image xyz = Image::make(steps, 1, {"X", "Y", "Z"});
    for (int i = 0; i < steps; ++i) {
        const double light = 0.18 * std::exp2(-8.0 + 16.0 * i / (steps - 1));
        for (int c = 0; c < 3; ++c)
            xyz.pixel(i, 0)[c] = static_cast<float>(light * srgb_white()[c]);
    }
    return xyz;
}

TEST(Config, SoftRisesAndKeepsMidGrey) {
    const Image xyz = grey_ramp(2001);
    const Image soft = display(xyz, srgb_white(), {.view = "Soft"});
    double worst = 0;
    for (int i = 0; i < soft.width; ++i) {
        const double light = xyz.pixel(i, 0)[1];
        worst = std::max(worst, std::abs(soft.pixel(i, 0)[0] - srgb_encode(soft_shoulder(light))));
        EXPECT_NEAR(soft.pixel(i, 0)[0], soft.pixel(i, 0)[2], 1e-5);
        if (i > 0) {
            EXPECT_GE(soft.pixel(i, 0)[1], soft.pixel(i - 1, 0)[1] - 1e-6f) << light;
        }
        if (light < 0.355) {
            EXPECT_NEAR(soft.pixel(i, 0)[1], srgb_encode(light), 1e-3) << light;
        }
    }
    EXPECT_LT(worst, 8e-4); // a fifth of an 8-bit code: the curve is saved as 12 points
    EXPECT_LT(soft.pixel(2000, 0)[1], 1.0f);
    // Two highlights that Plain clips stay apart.
    EXPECT_GT(soft.pixel(1600, 0)[1] - soft.pixel(1400, 0)[1], 0.01f);
}

TEST(Config, SoftShoulderHasTheNamedValues) {
    EXPECT_EQ(soft_shoulder(0.18), 0.18);
    EXPECT_EQ(soft_shoulder(0.0), 0.0);
    EXPECT_EQ(soft_shoulder(-0.1), -0.1);
    EXPECT_NEAR(soft_shoulder(1.0), 0.69, 0.005);
    EXPECT_NEAR(soft_shoulder(16.0), 0.98, 0.005);
}

TEST(Config, SavedFileGivesTheSameNumbers) {
    const test::Folder folder;
    const DisplayConfig config(lamps());
    config.save(folder / "tsuya.ocio");
    EXPECT_EQ(folder.size(), 1);
    const DisplayConfig loaded = DisplayConfig::load(folder / "tsuya.ocio");
    EXPECT_EQ(loaded.color_spaces(), config.color_spaces());
    const Image xyz = some_xyz();
    for (const std::string &view : view_names()) {
        const DisplayOptions options{.adapt = Adaptation::cat02, .view = view};
        const Image a = config.display(xyz, "HP4", options),
                    b = loaded.display(xyz, "HP4", options);
        for (std::size_t i = 0; i < a.data.size(); ++i)
            ASSERT_NEAR(a.data[i], b.data[i], 2e-6f) << view << ' ' << i;
    }
}

TEST(Config, NotFiniteStaysVisible) {
    Image xyz = grey_ramp(3);
    xyz.pixel(1, 0)[0] = std::numeric_limits<float>::quiet_NaN();
    xyz.pixel(2, 0)[2] = std::numeric_limits<float>::infinity();
    for (const std::string &view : view_names()) {
        const Image rgb = display(xyz, srgb_white(), {.view = view});
        EXPECT_TRUE(std::isfinite(rgb.data[0]));
        for (std::size_t i = 3; i < 9; ++i)
            EXPECT_TRUE(std::isnan(rgb.data[i])) << view << i;
    }
}

TEST(Config, FindsChannelsByName) {
    const Image xyz = some_xyz();
    Image shuffled = Image::make(xyz.width, xyz.height, {"A", "Z", "X", "Y"});
    for (int y = 0; y < xyz.height; ++y)
        for (int x = 0; x < xyz.width; ++x) {
            const float *v = xyz.pixel(x, y);
            const float moved[4] = {9.0f, v[2], v[0], v[1]};
            std::copy_n(moved, 4, shuffled.pixel(x, y));
        }
    EXPECT_EQ(display(xyz, srgb_white()).data, display(shuffled, srgb_white()).data);
}

TEST(Config, RefusesWrongInput) {
    const DisplayConfig config(lamps());
    const Image xyz = some_xyz();
    test::expect_problem([&] { config.display(xyz, "D60"); }, "display config", "D60 as seen");
    test::expect_problem([&] { config.display(xyz, "D65", {.view = "soft"}); }, "view",
                         "did you mean Soft?");
    test::expect_problem([&] { config.display(xyz, "D65", {.exposure_stops = NAN}); }, "exposure",
                         "not finite");
    test::expect_problem(
        [&] {
            config.display(Image::make(2, 2, {"R", "G", "B"}), "D65");
        },
        "picture", "no channel X");
    test::expect_problem([&] { config.display(Image{}, "D65"); }, "picture", "0 x 0");
    test::expect_problem([] { DisplayConfig({{"", glm::dvec3(1)}}); }, "lamps.0", "no name");
    test::expect_problem(
        [] {
            DisplayConfig({{"E", glm::dvec3(1)}, {"E", glm::dvec3(1)}});
        },
        "lamps.1", "twice");
    const test::Folder folder;
    const auto absent = folder / "absent.ocio";
    test::expect_problem([&] { DisplayConfig::load(absent); }, absent.string(), "OpenColorIO");
    const auto text = folder.write("wrong.ocio", "a dress is no config");
    test::expect_problem([&] { DisplayConfig::load(text); }, text.string(), "OpenColorIO");
    const auto nowhere = folder / "no/where.ocio";
    test::expect_problem([&] { config.save(nowhere); }, nowhere.string(), "folder");
}

} // namespace
} // namespace tsuya

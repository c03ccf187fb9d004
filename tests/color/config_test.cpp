#include "tsuya/color/config.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include <OpenColorIO/OpenColorIO.h>
#include <gtest/gtest.h>

#include <glm/matrix.hpp>

#include "color_test.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/rgb_primaries.h"
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
        if (light < 0.49) {
            EXPECT_NEAR(soft.pixel(i, 0)[1], srgb_encode(light), 1e-3) << light;
        }
    }
    EXPECT_LT(worst, 8e-4); // a fifth of an 8-bit code: the curve is saved as 14 points
    EXPECT_LT(soft.pixel(2000, 0)[1], 1.0f);
    // Two highlights that Plain clips stay apart.
    EXPECT_GT(soft.pixel(1600, 0)[1] - soft.pixel(1400, 0)[1], 0.01f);
}

TEST(Config, SoftShoulderHasTheNamedValues) {
    EXPECT_EQ(soft_shoulder(0.18), 0.18);
    EXPECT_EQ(soft_shoulder(0.0), 0.0);
    EXPECT_EQ(soft_shoulder(-0.1), -0.1);
    EXPECT_EQ(soft_shoulder(0.5), 0.5);
    EXPECT_NEAR(soft_shoulder(1.0), 0.775, 0.005);
    EXPECT_NEAR(soft_shoulder(16.0), 0.995, 0.002);
}

TEST(Config, SavedFileGivesTheSameNumbers) {
    const test::Folder folder;
    const DisplayConfig config(lamps());
    config.save(folder / "tsuya.ocio");
    EXPECT_EQ(folder.size(), 1);
    const DisplayConfig loaded = DisplayConfig::load(folder / "tsuya.ocio");
    EXPECT_EQ(loaded.color_spaces(), config.color_spaces());
    EXPECT_EQ(loaded.looks(), config.looks());
    const Image xyz = some_xyz();
    for (const std::string &view : view_names()) {
        const DisplayOptions options{.adapt = Adaptation::cat02, .view = view};
        const Image a = config.display(xyz, "HP4", options),
                    b = loaded.display(xyz, "HP4", options);
        for (std::size_t i = 0; i < a.data.size(); ++i)
            ASSERT_NEAR(a.data[i], b.data[i], 2e-6f) << view << ' ' << i;
    }
}

// The table by which `display` makes sRGB, against OpenColorIO's own processor.
TEST(Config, TheTableIsTheView) {
    const DisplayConfig config(lamps());
    const Image xyz = some_xyz();
    for (const std::string &view : view_names())
        for (const double stops : {0.0, -4.0, 3.0}) {
            const DisplayOptions options{.view = view, .exposure_stops = stops};
            const Image a = config.display(xyz, "", options),
                        b = display(xyz, srgb_white(), options);
            for (std::size_t i = 0; i < a.data.size(); ++i)
                ASSERT_NEAR(a.data[i], b.data[i], 0.5 / 65535) << view << ' ' << i;
        }
}

// Each display by its standard, computed here: white, a grey and the blue of Rec. 709.
TEST(Config, DisplaysHaveTheirPrimariesAndCurves) {
    const glm::dvec3 blue = xyz_from_srgb() * glm::dvec3(0, 0, 1);
    Image xyz = Image::make(3, 1, {"X", "Y", "Z"});
    for (int c = 0; c < 3; ++c) {
        xyz.pixel(0, 0)[c] = static_cast<float>(srgb_white()[c]);
        xyz.pixel(1, 0)[c] = static_cast<float>(0.18 * srgb_white()[c]);
        xyz.pixel(2, 0)[c] = static_cast<float>(blue[c]);
    }
    const auto shown = [&](const char *name) {
        return display(xyz, srgb_white(), {.display = name});
    };
    EXPECT_NEAR(shown("Display P3").pixel(1, 0)[1], srgb_encode(0.18), 1e-4);
    // Blue of sRGB in Display P3 is (0, 0, 0.9596) to four digits, as browsers show it.
    EXPECT_NEAR(shown("Display P3").pixel(2, 0)[2], 0.9596, 2e-4);
    EXPECT_NEAR(shown("Rec.709").pixel(1, 0)[1], std::pow(0.18, 1 / 2.4), 1e-4);
    // [BT2100] the inverse of PQ at 203 cd/m2 is 58.1 % [BT2408]
    EXPECT_NEAR(shown("Rec.2100-PQ").pixel(0, 0)[1], 0.5807, 1e-3);
    EXPECT_NEAR(shown("Rec.2100-HLG").pixel(0, 0)[1], 0.75, 1e-2);
    // Blue of Rec. 709, to four digits: [BT2087] the last column of M2
    const Image wide = shown("Rec.2020");
    const glm::dvec3 published(0.0433, 0.0114, 0.8956);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(std::pow(double(wide.pixel(2, 0)[c]), 2.4), published[c], 1e-4) << c;
}

// Half adapted: cones are scaled by half of what they would be.
TEST(Config, AdaptsByADegree) {
    const glm::dvec3 white = white_of(lamp("A"));
    Image xyz = Image::make(1, 1, {"X", "Y", "Z"});
    for (int c = 0; c < 3; ++c)
        xyz.pixel(0, 0)[c] = static_cast<float>(0.3 * white[c]);
    const auto rgb = [&](double degree) {
        const Image image = display(xyz, white, {.adapt = Adaptation::cat02, .degree = degree});
        return glm::dvec3(srgb_decode(image.data[0]), srgb_decode(image.data[1]),
                          srgb_decode(image.data[2]));
    };
    const glm::dvec3 none = rgb(0), half = rgb(0.5), full = rgb(1);
    EXPECT_NEAR(full.x, full.z, 1e-4);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(half[c], (std::max(none[c], 0.0) + full[c]) / 2, 0.01) << c;
    const glm::dvec3 direct =
        srgb_from_xyz() *
        (adaptation_matrix(Adaptation::cat02, white, srgb_white(), 0.5) * (0.3 * white));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(half[c], direct[c], 1e-4) << c;
}

TEST(Config, OthersReachItByTheRolesOfInterchange) {
    namespace OCIO = OCIO_NAMESPACE;
    std::istringstream text(DisplayConfig(lamps()).text());
    const auto ours = OCIO::Config::CreateFromStream(text);
    for (const auto &[space, encoding] :
         std::map<std::string, std::string>{{"CIE XYZ D65", "scene-linear"},
                                            {"ACEScg", "scene-linear"},
                                            {"Raw", "data"},
                                            {"sRGB", "sdr-video"},
                                            {"Rec.2100-PQ", "hdr-video"},
                                            {"CIE XYZ D65 - Display", "display-linear"}})
        EXPECT_EQ(ours->getColorSpace(space.c_str())->getEncoding(), encoding) << space;
    // Another program's config: ACEScg for scenes, XYZ for displays
    OCIO::ConfigRcPtr other = OCIO::Config::Create()->createEditableCopy();
    other->setVersion(2, 0);
    const auto add = [&](const char *name, OCIO::ReferenceSpaceType type) {
        OCIO::ColorSpaceRcPtr space = OCIO::ColorSpace::Create(type);
        space->setName(name);
        other->addColorSpace(space);
    };
    add("aces", OCIO::REFERENCE_SPACE_SCENE);
    add("xyz", OCIO::REFERENCE_SPACE_DISPLAY);
    other->setRole("aces_interchange", "aces");
    other->setRole("cie_xyz_d65_interchange", "xyz");
    const auto processor =
        OCIO::Config::GetProcessorFromConfigs(ours, "Linear Rec.709", other, "aces");
    float white[3] = {1, 1, 1};
    processor->getDefaultCPUProcessor()->applyRGB(white);
    for (const float v : white)
        EXPECT_NEAR(v, 1, 1e-4); // white stays white, adapted by Bradford
    EXPECT_NO_THROW(OCIO::Config::GetProcessorFromConfigs(ours, "sRGB", other, "xyz"));
}

// A saved config of ours, edited by nobody, is as good as that of another program.
TEST(Config, AConfigOfOnesOwnTakesTheirPlace) {
    const test::Folder folder;
    full_config().save(folder / "own.ocio");
    const Image xyz = some_xyz();
    const glm::dvec3 white = white_of(lamp("HP4"));
    for (const char *name : {"sRGB", "Display P3"}) {
        const DisplayOptions inside{.adapt = Adaptation::cat02, .view = "Soft", .display = name};
        DisplayOptions outside = inside;
        outside.config = folder / "own.ocio";
        const Image a = display(xyz, white, inside), b = display(xyz, white, outside);
        for (std::size_t i = 0; i < a.data.size(); ++i)
            ASSERT_NEAR(a.data[i], b.data[i], 2e-4) << name << ' ' << i;
    }
    // Nothing is named: the first display and its first view
    const DisplayOptions first{.view = "", .display = "", .config = folder / "own.ocio"};
    EXPECT_NEAR(display(xyz, white, first).data[100], display(xyz, white).data[100], 2e-4);
    const std::string path = (folder / "own.ocio").string();
    test::expect_problem([&] { display(xyz, white, {.view = "Bright", .config = path}); },
                         path + ", sRGB", "no view 'Bright'");
    test::expect_problem([&] { display(xyz, white, {.display = "projector", .config = path}); },
                         path, "no display 'projector'");
    const auto bare = folder.write("bare.ocio", "ocio_profile_version: 2\nroles:\n  default: "
                                                "raw\nfile_rules:\n  - !<Rule> {name: Default, "
                                                "colorspace: default}\ndisplays:\n  d:\n    - "
                                                "!<View> {name: v, colorspace: raw}\n"
                                                "colorspaces:\n  - !<ColorSpace>\n    name: raw\n");
    test::expect_problem([&] { display(xyz, white, {.config = bare}); }, bare.string(),
                         "no role aces_interchange");
    const auto absent = folder / "absent.ocio";
    test::expect_problem([&] { display(xyz, white, {.config = absent}); }, absent.string(),
                         "OpenColorIO");
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
    test::expect_problem([&] { config.display(xyz, "D60", {.adapt = Adaptation::cat02}); },
                         "display config", "no look 'D60 cat02'");
    test::expect_problem([&] { display(xyz, srgb_white(), {.display = "P3"}); }, "display",
                         "no display 'P3'");
    test::expect_problem(
        [&] { display(xyz, srgb_white(), {.view = "Soft", .display = "Rec.2100-PQ"}); }, "view",
        "expected Plain");
    test::expect_problem(
        [&] { display(xyz, srgb_white(), {.adapt = Adaptation::cat02, .degree = 1.5}); }, "degree",
        "expected 0 to 1");
    test::expect_problem(
        [&] { config.display(xyz, "HP4", {.adapt = Adaptation::cat02, .degree = 0.5}); }, "degree",
        "expected 1");
    EXPECT_NO_THROW(config.display(xyz, "HP4", {.degree = 0.5})); // nothing to adapt by a degree
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

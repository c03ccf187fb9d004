// Environments that are made: gradients, skies, and pictures in colour as mixtures of lamps.

#include <gtest/gtest.h>

#include <cmath>

#include "samples/scratch.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/scene/environment_colours.h"
#include "tsuya/scene/scene_file.h"
#include "tsuya/scene/sky.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

TEST(Gradient, GoesFromBelowToAbove) {
    const Image picture = gradient_picture(1, 2, 5);
    EXPECT_NEAR(picture.data.front(), 5, 0.01);
    EXPECT_NEAR(picture.data[picture.data.size() / 2], 2, 0.01);
    EXPECT_NEAR(picture.data[picture.data.size() / 4], 3.5, 0.01);
    EXPECT_NEAR(picture.data.back(), 1, 0.01);
    // The mean of 2 + 3 e / (pi / 2) over a level plane: e the elevation
    EXPECT_NEAR(level_irradiance({.picture = picture}), kPi * 3.5, 0.01);
    EXPECT_NEAR(level_irradiance({.radiance = 3}), 3 * kPi, 1e-12);
}

TEST(Sky, GivesALevelPlaneThePower) {
    for (int type = 1; type <= 15; ++type) {
        const Image picture = sky_picture({.type = type});
        EXPECT_NEAR(level_irradiance({.picture = picture}), kPi, 1e-4) << type;
        for (const float value : picture.data)
            ASSERT_GE(value, 0) << type;
        EXPECT_EQ(*picture.pixel(5, picture.height - 1), 0.2f);
    }
}

TEST(Sky, IsBrightestAtTheSunWhereItIsClear) {
    const Sky clear{.type = 12, .azimuth = 1, .elevation = 0.7};
    const Image picture = sky_picture(clear);
    const auto at = [&](double azimuth, double elevation) {
        const auto x = static_cast<int>((azimuth / (2 * kPi) + 0.5) * picture.width);
        return double(
            *picture.pixel(x, static_cast<int>((0.5 - elevation / kPi) * picture.height)));
    };
    EXPECT_GT(at(1, 0.7), 4 * at(1 - kPi, 0.7));
    EXPECT_GT(at(1, 0.05), at(1 - kPi, 0.7)); // and paler at the horizon
    // [ISO15469]: type 1 is three times as bright at the zenith as at the horizon, type 5 even
    const Image overcast = sky_picture({.type = 1}), even = sky_picture({.type = 5});
    const int last = overcast.height / 2 - 1;
    EXPECT_NEAR(*overcast.pixel(0, 0) / *overcast.pixel(0, last), 1 + 4 * std::exp(-0.7), 0.1);
    EXPECT_NEAR(*even.pixel(0, 0), 1, 1e-3);
    EXPECT_NEAR(*even.pixel(7, last), 1, 1e-3);
}

// X, Y, Z of a pixel under the lamps, each of which relighting gives Y = 1.
glm::dvec3 xyz_of_pixel(const Image &picture, int x) {
    const auto lamps = environment_lamps();
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k < kEnvironmentLamps; ++k)
        sum += double(picture.pixel(x, 0)[k]) * white_of(lamps[k]);
    return sum;
}

TEST(EnvironmentColours, AreMixedOfLampsThatSumToDaylight) {
    const auto lamps = environment_lamps();
    for (int nm = 400; nm <= 700; nm += 50)
        EXPECT_NEAR(lamps[0].at(nm) + lamps[1].at(nm) + lamps[2].at(nm), lamp("D65").at(nm), 1e-9);

    Image rgb = Image::make(4, 1, {"R", "G", "B"});
    const float pixels[] = {1, 1, 1, 0.9f, 0.6f, 0.4f, 0.3f, 0.5f, 0.8f, 20, 10, 6};
    std::copy(std::begin(pixels), std::end(pixels), rgb.data.begin());
    const EnvironmentColours colours = environment_colours(rgb);
    EXPECT_LT(colours.error, 1e-6);
    EXPECT_NEAR(glm::distance(xyz_of_pixel(colours.picture, 0), white_of(lamp("D65"))), 0, 1e-6);
    for (int x = 0; x < 4; ++x) {
        const glm::dvec3 xyz = xyz_of_pixel(colours.picture, x);
        const glm::dvec3 expected =
            xyz_from_srgb() *
            glm::dvec3(rgb.pixel(x, 0)[0], rgb.pixel(x, 0)[1], rgb.pixel(x, 0)[2]);
        EXPECT_NEAR(glm::distance(xyz, expected) / glm::length(expected), 0, 2e-3) << x;
    }
}

TEST(EnvironmentColours, TellTheErrorOfSaturatedOnes) {
    Image rgb = Image::make(2, 1, {"B", "G", "R"}); // in any order
    rgb.data = {0, 1, 0, 1, 1, 1};
    const EnvironmentColours green = environment_colours(rgb);
    EXPECT_GT(green.error, 0.01);
    EXPECT_LT(green.error, 0.3);
    EXPECT_GT(green.picture.pixel(0, 0)[1], 5 * green.picture.pixel(0, 0)[0]);
    for (const float value : green.picture.data)
        EXPECT_GE(value, 0);
    EXPECT_THROW(environment_colours(Image::make(2, 1, {"Y"})), Error);
}

SceneFile read(const Scratch &scratch, const std::string &lights) {
    scratch.write("cloth.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    Image rgb = Image::make(4, 2, {"R", "G", "B"});
    std::fill(rgb.data.begin(), rgb.data.end(), 0.5f);
    write_exr(scratch / "sky.exr", rgb);
    return read_scene_file(scratch.write(
        "a.scene.toml",
        "[fabrics.silk]\n[bodies.cloth]\nmesh = \"cloth.obj\"\nfabric = \"silk\"\n" + lights));
}

TEST(SceneEnvironment, HasItsKeys) {
    const Scratch scratch;
    const SceneFile gradient =
        read(scratch, "[environment]\ngradient = [0, 1, 2]\nlux = 2000\nlamp = \"A\"\n");
    EXPECT_NEAR(level_irradiance(*gradient.environment), 2 * kPi, 1e-6);
    EXPECT_EQ(gradient.own_lamps, std::vector<std::string>{"A"});

    const SceneFile sky = read(scratch, "[lights.sun]\ntype = \"sun\"\nazimuth_deg = 90\n"
                                        "[environment]\nsky = { type = 13, ground = 0.5 }\n");
    const Image as_sun = sky_picture(
        {.type = 13, .azimuth = 90 * kDegree, .elevation = 45 * kDegree, .ground = 0.5});
    EXPECT_EQ(sky.environment->picture->data, as_sun.data);

    const SceneFile coloured =
        read(scratch, "[environment]\npicture = \"sky.exr\"\ncolour = true\nturn_deg = 90\n");
    EXPECT_EQ(
        coloured.light_groups,
        (std::vector<std::string>{"environment-red", "environment-green", "environment-blue"}));
    EXPECT_EQ(coloured.own_lamps, coloured.light_groups);
    EXPECT_NEAR(coloured.environment->turn, 90 * kDegree, 1e-12);
    EXPECT_LT(coloured.environment_error.value(), 1e-6);
    const float *const pixel = coloured.environment->picture->pixel(0, 0);
    EXPECT_NEAR(pixel[0] + pixel[1] + pixel[2], 0.5, 1e-3);
}

TEST(SceneEnvironment, IsRefusedAtItsPlace) {
    const Scratch scratch;
    const auto problem = [&](const std::string &keys) {
        try {
            read(scratch, "[environment]\n" + keys);
        } catch (const Error &error) {
            EXPECT_EQ(error.problems().size(), 1u) << error.what();
            const std::string file = (scratch / "a.scene.toml").string() + ":";
            return error.problems()[0].where.substr(file.size()) + " " + error.problems()[0].what;
        }
        return std::string("accepted");
    };
    EXPECT_EQ(problem("gradient = [0, 1]\n"), "6:12 the gradient is not three radiances");
    EXPECT_EQ(problem("gradient = [0, 1, -1]\n"), "6:12 the gradient is not three radiances");
    EXPECT_EQ(problem("picture = \"sky.exr\"\ngradient = [0, 1, 2]\n"),
              "7:12 picture and gradient are both given");
    EXPECT_EQ(problem("picture = \"no.exr\"\n").substr(0, 5), "6:11 ");
    EXPECT_EQ(problem("lux = 3\nradiance = 2\n"), "6:7 radiance and lux are both given");
    EXPECT_EQ(problem("gradient = [1, 0, 0]\nlux = 3\n"),
              "7:7 nothing shines from above the horizon");
    EXPECT_EQ(problem("sky = { type = 16 }\n").substr(0, 5), "6:16 ");
    EXPECT_EQ(problem("lamp = \"D66\"\n").substr(0, 4), "6:8 ");
    EXPECT_EQ(problem("picture = \"sky.exr\"\ncolour = true\n[lights.a]\ntype = \"sun\"\n"
                      "group = \"environment\"\n"),
              "5:1 a light is in the group of a coloured environment");
}

} // namespace
} // namespace tsuya::scene

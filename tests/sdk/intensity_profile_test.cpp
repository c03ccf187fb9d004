// Luminous intensities of luminaires: their files, symmetries, and the light that they give.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/intensity_profile.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// Lines 1 to 4 are the heading.
std::string ies(const std::string &numbers, const std::string &tilt = "NONE") {
    return "IESNA:LM-63-1995\n[TEST] made up\n[MANUFAC] nobody\nTILT=" + tilt + "\n" + numbers;
}

// Intensities that say where they are: 100 times the number of the horizontal angle and the
// number of the vertical one, counted from 1.
std::string numbered(const std::string &vertical, const std::string &horizontal, int v, int h) {
    std::string text = "1 1000 2 " + std::to_string(v) + " " + std::to_string(h) +
                       " 1 2 0 0 0\n0.5 1 100\n" + vertical + "\n" + horizontal + "\n";
    for (int j = 1; j <= h; ++j)
        for (int i = 1; i <= v; ++i)
            text += std::to_string(100 * j + i) + (i == v ? "\n" : " ");
    return ies(text);
}

double at(const IntensityProfile &profile, double vertical_deg, double horizontal_deg) {
    return profile.at(vertical_deg * kDegree, horizontal_deg * kDegree);
}

TEST(IntensityProfile, IsReadAndInterpolated) {
    const auto profile = parse_ies(numbered("0 45 90", "0 120,\n240 360", 3, 4), "a.ies");
    // Multiplier times ballast factor is 1
    EXPECT_DOUBLE_EQ(at(profile, 0, 0), 101);
    EXPECT_NEAR(at(profile, 22.5, 0), 101.5, 1e-9);
    EXPECT_NEAR(at(profile, 45, 60), 152, 1e-9);
    EXPECT_NEAR(at(profile, 67.5, 300), 352.5, 1e-9);
    EXPECT_NEAR(at(profile, 67.5, -60), 352.5, 1e-9);
    EXPECT_EQ(at(profile, 91, 0), 0);
    EXPECT_NEAR(profile.highest(), 403, 1e-9);
    EXPECT_NEAR(profile.last_angle(), 90 * kDegree, 1e-12);
}

TEST(IntensityProfile, HasTheSymmetryOfItsAngles) {
    const auto all = parse_ies(numbered("0 90", "0", 2, 1), "a.ies");
    EXPECT_EQ(at(all, 90, 217), 102);
    const auto quarter = parse_ies(numbered("0 90", "0 90", 2, 2), "a.ies");
    const auto half = parse_ies(numbered("0 90", "0 90 180", 2, 3), "a.ies");
    for (const double angle : {30.0, 150.0, 210.0, 330.0})
        EXPECT_NEAR(at(quarter, 90, angle), 102 + 100.0 / 3, 1e-9) << angle;
    for (const double angle : {150.0, 210.0})
        EXPECT_NEAR(at(half, 90, angle), 202 + 200.0 / 3, 1e-9) << angle;
    EXPECT_NEAR(at(half, 90, -30), 102 + 100.0 / 3, 1e-9);
    const auto turned = parse_ies(numbered("0 90", "90 180 270", 2, 3), "a.ies");
    EXPECT_EQ(turned.horizontal.front(), 0);
    EXPECT_EQ(at(turned, 90, 90), 202);
}

// Directions by hand: one who looks ahead with `up` above has `right` to the right.
TEST(IntensityProfile, HasTheAnglesOfItsType) {
    const auto profile = [](int type, std::string text) {
        return parse_ies(text.replace(text.find(" 1 2 0 0 0"), 2, " " + std::to_string(type)),
                         "a.ies");
    };
    const auto towards = [](const IntensityProfile &of, double right, double up, double ahead) {
        return of.at(std::acos(ahead), std::atan2(-right, up));
    };
    const double half = std::sqrt(0.5), wide = std::sqrt(0.75);
    const std::string all = numbered("-90 0 45 90", "-90 0 60 90", 4, 4);
    for (const int type : {2, 3}) {
        const IntensityProfile p = profile(type, all);
        EXPECT_NEAR(towards(p, 0, 0, 1), 202, 1e-9) << "H 0, V 0";
        EXPECT_NEAR(towards(p, 0, half, half), 203, 1e-9) << "V 45";
        EXPECT_NEAR(towards(p, wide, 0, 0.5), 302, 1e-9) << "H 60";
        EXPECT_NEAR(towards(p, 0, -half, half), 201.5, 1e-9) << "V -45";
        EXPECT_NEAR(p.last_angle(), kHalfPi, 1e-12);
        EXPECT_EQ(towards(p, 0, 0.6, -0.8), 0) << "behind";
    }
    // H 60 and V 45 at once: in A the height is the sine of V, in B the side is that of H. The grid
    // about the axis is half a degree wide.
    EXPECT_NEAR(towards(profile(3, all), half * wide, half, half * 0.5), 303, 1);
    EXPECT_NEAR(towards(profile(2, all), wide, half * 0.5, half * 0.5), 303, 1);
    EXPECT_GT(std::abs(towards(profile(3, all), wide, half * 0.5, half * 0.5) - 303), 15);
    // From 0 on both sides are alike; beyond the last angle it is dark
    const auto even = profile(3, numbered("-20 20", "0 30", 2, 2));
    EXPECT_NEAR(towards(even, std::sin(kDegree * 15), 0, std::cos(kDegree * 15)), 151.5, 1e-9);
    EXPECT_NEAR(towards(even, -std::sin(kDegree * 15), 0, std::cos(kDegree * 15)), 151.5, 1e-9);
    EXPECT_EQ(towards(even, 0.6, 0, 0.8), 0);
    EXPECT_EQ(towards(even, 0, 0.5, wide), 0);
}

TEST(IntensityProfile, MayHaveTiltFactors) {
    const std::string numbers = "1 1000 1 2 1 1 2 0 0 0\n1 1 100\n0 90\n0\n5 6\n";
    EXPECT_EQ(at(parse_ies(ies("1\n3\n0 45 90\n1 .9 .8\n" + numbers, "INCLUDE"), "a.ies"), 90, 0),
              6);
}

TEST(IntensityProfile, IsRefusedAtItsLine) {
    struct Bad {
        std::string text;
        const char *line, *what;
    };
    const std::string good = numbered("0 45 90", "0 90", 3, 2);
    const auto with = [&](const std::string &from, const std::string &to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    const Bad all[] = {
        {"IESNA:LM-63-1995\nnothing\n", ":2", "TILT"},
        {with("TILT=NONE", "TILT=lamp.tlt"), ":4", "lamp.tlt"},
        {with("1 1000 2 3", "1 1000 two 3"), ":5", "candela multiplier is 'two'"},
        {with("1 1000 2 3", "1 1000 0 3"), ":5", "multiplier is 0"},
        {with("1 1000 2 3", "1 1000 2 1"), ":5", "vertical angles is 1"},
        {with("1 1000 2 3", "1 1000 2 2.5"), ":5", "vertical angles is 2.5"},
        {with("2 1 2 0", "2 4 2 0"), ":5", "photometric type 4"},
        {with("0 45 90\n0 90", "0 45 95\n0 90").replace(good.find("2 1 2 0"), 3, "2 2"), ":7",
         "vertical angles go from 0 to 95"},
        {with("0 45 90\n0 90", "0 45 90\n30 90").replace(good.find("2 1 2 0"), 3, "2 3"), ":8",
         "do not reach"},
        {with("0 45 90\n0 90", "0 45 90\n-90 0").replace(good.find("2 1 2 0"), 3, "2 2"), ":8",
         "do not reach"},
        {with("0 45 90", "0 45 45"), ":7", "no larger"},
        {with("0 45 90", "0 45 190"), ":7", "190"},
        {with("0 90\n", "0 80\n"), ":8", "80"},
        {with("102 ", "-102 "), ":9", "below 0"},
        {with("\n201 202 203\n", "\n201 202\n"), ":10", "ends where the intensity"},
        {with("0.5 1 100", "0.5 nan 100"), ":6", "nan"},
        {ies("1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n0 0\n"), ":9", "dark"},
    };
    for (const Bad &bad : all)
        try {
            parse_ies(bad.text, "a.ies");
            ADD_FAILURE() << bad.what << " was accepted";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].where, std::string("a.ies") + bad.line) << bad.what;
            EXPECT_NE(error.problems()[0].what.find(bad.what), std::string::npos)
                << error.problems()[0].what;
        }
}

// A floor under a luminaire, beside the closed form; turned about its axis, and tilted.
TEST(IntensityProfile, LightsAFloor) {
    PointLight light{.position = {0, 2, 0},
                     .intensity = 0.01,
                     .profile = parse_ies(numbered("0 90", "0 90 180 270 360", 2, 5), "a.ies")};
    std::copy_n(light.profile->candela.begin(), 2, light.profile->candela.end() - 2); // 360 is 0
    Scene scene;
    scene.surfaces = {floor_square(40)};
    scene.fabrics = {lambert(0.5)};
    scene.objects = {{"floor", {0}, {0}}};
    scene.camera = {.up = {0, 0, -1}, .vertical_angle = 1e-4, .width = 4, .height = 4};
    RenderSettings settings = quick(16);
    settings.max_bounces = 0;
    const auto lit = [&](const glm::dvec3 &point) {
        scene.lights = {light};
        scene.camera.eye = point + glm::dvec3(0, 0.2, 0);
        scene.camera.target = point;
        EXPECT_NEAR(*render(scene, settings).image.pixel(0, 1, 1),
                    0.5 / kPi * irradiance(light, point, {0, 1, 0}), 1e-4)
            << point.x << " " << point.z;
        return irradiance(light, point, {0, 1, 0});
    };
    // Half a right angle from the axis, to the four sides: C0 is +z, C90 is +x seen from above
    const double toward = std::pow(std::sqrt(0.5), 3) / 4;
    EXPECT_NEAR(lit({0, 0, 2}), 0.01 * 101.5 * toward, 1e-6);
    EXPECT_NEAR(lit({2, 0, 0}), 0.01 * 201.5 * toward, 1e-6);
    EXPECT_NEAR(lit({0, 0, -2}), 0.01 * 301.5 * toward, 1e-6);
    EXPECT_NEAR(lit({-2, 0, 0}), 0.01 * 401.5 * toward, 1e-6);
    light.zero_plane = {1, 0, 0};
    EXPECT_NEAR(lit({2, 0, 0}), 0.01 * 101.5 * toward, 1e-6);
    light.direction = {1, -1, 0}; // beyond 90 degrees it is dark
    EXPECT_EQ(lit({-3, 0, 0}), 0);
    // Flux: even all around of the mean, 101 to 102 and on
    light.profile = IntensityProfile{{0, kPi}, {0}, {2, 2}};
    EXPECT_NEAR(flux(light), 4 * kPi * 0.02, 1e-5);
}

} // namespace

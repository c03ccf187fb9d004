// How yarns lie in a weave: pressed, bent, twisted; weave_preset_test.cpp asks the same of every
// preset.

#include "tsuya/lab/weave_geometry.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "lab/mean_height.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

// Pressed yarns are as wide as their spacing, thicker, and of the same filaments.
TEST(WeaveGeometry, YarnsThatAreWiderThanTheirSpacingArePressed) {
    Weave cloth = weave("black polyester satin");
    ASSERT_GT(cloth.warp.width, 1.1 * cloth.warp.spacing());
    const WeaveReport pressed = report_weave(cloth);
    EXPECT_NEAR(pressed.cover, 1, 1e-3);
    EXPECT_NEAR(pressed.neighbour_gap, 0, 1e-9);
    EXPECT_GT(pressed.warp_thickness, 1.1 * cloth.warp.thickness());
    cloth.warp.per_cm = 0.009 / cloth.warp.width; // control: room for all of the width
    const WeaveReport loose = report_weave(cloth);
    EXPECT_LT(loose.cover, 0.99);
    EXPECT_GT(loose.neighbour_gap, 0.05 * cloth.warp.width);
    EXPECT_NEAR(loose.warp_thickness, cloth.warp.thickness(), 1e-9);
    EXPECT_NEAR(loose.warp_decitex / pressed.warp_decitex, 1, 0.01);
}

TEST(WeaveGeometry, ASatinShowsItsWarp) {
    for (const char *name : {"black polyester satin", "silk charmeuse"}) {
        const WeaveReport report = report_weave(weave(name));
        EXPECT_GT(report.warp_on_face, 0.75) << name;
        EXPECT_LT(report.weft_on_face, 0.25) << name;
    }
    const WeaveReport plain = report_weave(weave("silk habotai"));
    EXPECT_NEAR(plain.warp_on_face, plain.weft_on_face, 0.1);
}

// The energy has one minimum, and all ends of a satin are the same but for a shift: so are their
// paths if that minimum was reached.
TEST(WeaveGeometry, EndsOfASatinAreAlike) {
    const Weave cloth = weave("black polyester satin");
    const FilamentRepeat repeat = build_filaments(cloth);
    const int points = GeometryOptions{}.points_per_crossing;
    for (int e = 1; e < 5; ++e) {
        int shift = 0;
        while (cloth.draft.up(e, shift) || cloth.draft.up(0, 0))
            ++shift;
        for (int k = 0; k < 5 * points; ++k)
            EXPECT_NEAR(mean_height(repeat, 0, 0, k),
                        mean_height(repeat, 0, e, (k + shift * points) % (5 * points)), 0.5e-6)
                << e << " " << k;
    }
}

TEST(WeaveGeometry, WarpAndWeftOfABalancedPlainWeaveAreAlike) {
    Weave cloth;
    cloth.draft = plain_weave();
    const WeaveReport report = report_weave(cloth);
    EXPECT_NEAR(report.warp_crimp, report.weft_crimp, 1e-4);
    EXPECT_NEAR(report.thickness, 2 * cloth.warp.thickness(), 0.08 * cloth.warp.thickness());
}

// Crimp interchange [Peirce]: what one system loses the other gains. Exchanged pulls exchange the
// crimps; equal ones of any size change nothing.
TEST(WeaveGeometry, TheYarnsThatArePulledMoreLieStraighter) {
    Weave cloth;
    cloth.draft = plain_weave();
    cloth.warp.width = cloth.weft.width = 0.15e-3;
    const WeaveReport even = report_weave(cloth);
    cloth.warp.tension = cloth.weft.tension = 7;
    EXPECT_NEAR(report_weave(cloth).warp_crimp, even.warp_crimp, 1e-6);
    double last = even.weft_crimp;
    for (const double tension : {14.0, 35.0}) {
        cloth.weft.tension = tension;
        const WeaveReport tight = report_weave(cloth);
        EXPECT_LT(tight.weft_crimp, 0.7 * last) << tension;
        EXPECT_GT(tight.warp_crimp, 1.1 * even.warp_crimp) << tension;
        last = tight.weft_crimp;
        std::swap(cloth.warp.tension, cloth.weft.tension);
        EXPECT_NEAR(report_weave(cloth).warp_crimp, tight.weft_crimp, 1e-4) << tension;
        std::swap(cloth.warp.tension, cloth.weft.tension);
    }
}

// What makes it shine: of what is seen of the warp, most is level along it.
TEST(WeaveGeometry, FloatsOfASatinLieFlat) {
    const auto level_share = [](const Weave &cloth) {
        const FilamentRepeat repeat = build_filaments(cloth);
        const int places = GeometryOptions{}.points_per_crossing * cloth.draft.picks;
        int level = 0;
        for (int k = 0; k < places; ++k) {
            const double rise =
                mean_height(repeat, 0, 0, (k + 1) % places) - mean_height(repeat, 0, 0, k);
            level += std::abs(rise) < 0.03 * repeat.size.y / places; // 1.7 degrees
        }
        return level / double(places);
    };
    Weave cloth = weave("black polyester satin");
    EXPECT_GT(level_share(cloth), 0.65);
    EXPECT_GT(level_share(weave("silk charmeuse")), 0.65);
    cloth.weft.tension = cloth.warp.tension; // control: the weft bends too, and lifts the floats
    EXPECT_LT(level_share(cloth), 0.5);
}

// [Peirce]: flat on the crossed yarn, an arc of the radius R about its edge, and a straight line to
// the middle between two yarns, where the arc ends at the angle a with dx sin a + R/2 cos a = R.
TEST(WeaveGeometry, AThreadInAPlainWeaveTakesThePathOfPeirce) {
    Weave cloth;
    cloth.warp.width = cloth.weft.width = 0.15e-3;
    const GeometryOptions options{.points_per_crossing = 48, .stiffness_length = 0};
    const double half = cloth.warp.spacing() / 2, radius = cloth.warp.thickness();
    const double flat = (cloth.warp.width - cloth.warp.thickness()) / 2;
    const double far = std::hypot(half - flat, radius / 2);
    const double angle = std::asin(radius / far) - std::atan2(radius / 2, half - flat);
    const double length = flat + radius * angle + std::sqrt(far * far - radius * radius);
    const WeaveReport report = report_weave(cloth, options);
    EXPECT_NEAR(report.warp_crimp, length / half - 1, 0.02 * (length / half - 1));
    EXPECT_NEAR(report.weft_crimp, report.warp_crimp, 1e-5);
    EXPECT_NEAR(report.thickness, 2 * radius, 0.01 * radius);
    const FilamentRepeat repeat = build_filaments(cloth, options);
    double steepest = 0;
    for (int k = 0; k < 95; ++k)
        steepest = std::max(
            steepest, std::abs(mean_height(repeat, 0, 0, k + 1) - mean_height(repeat, 0, 0, k)));
    EXPECT_NEAR(steepest * 48 / cloth.weft.spacing(), std::tan(angle), 0.03 * std::tan(angle));
}

// The limit of [Peirce], for flat sections with his spacings less the flat parts: the yarns keep
// their sections below it, and squeeze each other beyond.
TEST(WeaveGeometry, YarnsThatJamSqueezeEachOther) {
    const auto plain = [](double per_cm) {
        Weave cloth;
        cloth.name = "jammed";
        cloth.warp = {.per_cm = per_cm, .width = 0.15e-3, .flattening = 0.22, .filaments = 20};
        cloth.weft = cloth.warp;
        return cloth;
    };
    const auto jam = [](const Weave &cloth) { // at most 1
        const double free = cloth.warp.spacing() - cloth.warp.width + cloth.warp.thickness();
        const double share = free / (2 * cloth.warp.thickness());
        return 2 * std::sqrt(std::max(0.0, 1 - share * share));
    };
    const Weave open = plain(55), jammed = plain(58);
    ASSERT_LT(jam(open), 0.98);
    ASSERT_GT(jam(jammed), 1.02);
    const GeometryOptions fine{.points_per_crossing = 48};
    const WeaveReport free = report_weave(open, fine), squeezed = report_weave(jammed, fine);
    EXPECT_EQ(free.squeeze, 0);
    EXPECT_NEAR(free.warp_thickness, open.warp.thickness(), 1e-9);
    EXPECT_GT(squeezed.squeeze, 0);
    EXPECT_LT(squeezed.squeeze, 0.1);
    EXPECT_GT(squeezed.warp_thickness, jammed.warp.thickness());
    EXPECT_GT(squeezed.warp_weft_gap, -0.25e-6);
    EXPECT_NEAR(squeezed.warp_decitex / free.warp_decitex, 1, 0.02);
    EXPECT_THROW(report_weave(plain(66)), Error);
}

TEST(WeaveGeometry, WeavesOfTheStudyHaveRoom) {
    int count = 0;
    for (const auto &entry : std::filesystem::directory_iterator(TSUYA_STUDY_WEAVES)) {
        const WeaveReport report =
            report_weave(read_weave(entry.path()), {.points_per_crossing = 24});
        EXPECT_GT(report.warp_weft_gap, -0.5e-6) << entry.path();
        EXPECT_LT(report.squeeze, 0.03) << entry.path();
        ++count;
    }
    EXPECT_GT(count, 20);
}

TEST(WeaveGeometry, FinerPointsGiveTheSameCloth) {
    const Weave cloth = weave("twill lining");
    const WeaveReport coarse = report_weave(cloth);
    const WeaveReport fine = report_weave(cloth, {.points_per_crossing = 32});
    EXPECT_NEAR(coarse.thickness, fine.thickness, 0.03 * fine.thickness);
    EXPECT_NEAR(coarse.warp_on_face, fine.warp_on_face, 0.05);
}

// Z twist turns right-handed about the path, of warp and of weft, by whole turns.
TEST(WeaveGeometry, TwistTurnsFilamentsAboutTheirYarn) {
    Weave cloth;
    cloth.draft = twill(2, 2);
    cloth.warp.twist_per_m = 480;
    cloth.weft.twist_per_m = -1950;
    cloth.warp.section = cloth.weft.section = FilamentSection::triangular;
    const GeometryOptions options;
    const WeaveReport report = report_weave(cloth, options);
    EXPECT_NEAR(report.warp_twist_per_m, 480, 48);
    EXPECT_NEAR(report.weft_twist_per_m, -1950, 195);
    const FilamentRepeat repeat = build_filaments(cloth, options);
    for (const Filament *f : {&repeat.filaments.front(), &repeat.filaments.back() - 20}) {
        const int n = static_cast<int>(f->point.size());
        const double across_axis =
            (f->yarn + 0.5) * (f->system == 0 ? cloth.warp.spacing() : cloth.weft.spacing());
        double turned = 0;
        const auto angle = [&](int i) {
            const glm::vec3 p = f->point[static_cast<std::size_t>(i % n)];
            const double z = p.z - mean_height(repeat, f->system, static_cast<int>(f->yarn), i % n);
            return f->system == 0 ? std::atan2(z, across_axis - p.x)
                                  : std::atan2(z, p.y - across_axis);
        };
        for (int i = 0; i < n; ++i)
            turned += std::remainder(angle(i + 1) - angle(i), 2 * std::numbers::pi);
        const double length = f->system == 0 ? repeat.size.y : repeat.size.x;
        const double asked = f->system == 0 ? report.warp_twist_per_m : report.weft_twist_per_m;
        EXPECT_NEAR(turned / (2 * std::numbers::pi), asked * length, 0.01);
        EXPECT_NEAR((f->turn.back() - f->turn.front()) / (2 * std::numbers::pi),
                    asked * length * (n - 1) / n, 0.1);
    }
}

TEST(WeaveGeometry, SeedsMoveFilamentsAndNothingElse) {
    const Weave cloth = weave("black polyester satin");
    const FilamentRepeat one = build_filaments(cloth), same = build_filaments(cloth),
                         other = build_filaments(cloth, {.seed = 2});
    ASSERT_EQ(one.filaments.size(), other.filaments.size());
    int moved = 0;
    for (std::size_t i = 0; i < one.filaments.size(); ++i) {
        EXPECT_EQ(one.filaments[i].point, same.filaments[i].point);
        moved += one.filaments[i].point != other.filaments[i].point;
    }
    EXPECT_GT(moved, 200);
    EXPECT_NE(one.filaments[0].point[0].z, one.filaments[24].point[0].z);
}

TEST(WeaveGeometry, OptionsAndSizesOutOfRangeAreRefused) {
    const Weave cloth = weave("polyester taffeta");
    for (const GeometryOptions &options :
         {GeometryOptions{.points_per_crossing = 3}, GeometryOptions{.points_per_crossing = 13},
          GeometryOptions{.points_per_crossing = 66}, GeometryOptions{.wavelength_nm = 300},
          GeometryOptions{.stiffness_length = -1}, GeometryOptions{.tiles_x = 17},
          GeometryOptions{.tiles_y = -1}})
        EXPECT_THROW(build_filaments(cloth, options), Error);
    Weave hard = cloth;
    hard.weft.per_cm = 5;
    hard.warp.twist_per_m = 3000;
    EXPECT_THROW(build_filaments(hard), Error);
    EXPECT_NO_THROW(build_filaments(hard, {.points_per_crossing = 64}));
    Weave jammed = weave("polyester taffeta"); // no room for the warp between the picks
    jammed.weft.width = 0.32e-3;
    try {
        report_weave(jammed);
        ADD_FAILURE();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "polyester taffeta");
        EXPECT_TRUE(error.problems()[0].what.starts_with("the yarns pass through each other"));
    }
    Weave large = cloth;
    large.draft = twill(200, 200);
    EXPECT_THROW(build_filaments(large), Error);
    large.draft = {};
    EXPECT_THROW(build_filaments(large), Error);
}

} // namespace
} // namespace tsuya::lab

// Filaments of a weave: periodic, on the side that the draft says, and never through each other.

#include "tsuya/lab/weave_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

/// Of the sum of the radii, by which filaments of different yarns may overlap.
constexpr double kTolerance = 0.02;

/// A point of a path, which goes on beyond its ends a repeat further.
glm::dvec3 periodic(const FilamentRepeat &repeat, const Filament &f, int i) {
    const int n = static_cast<int>(f.point.size());
    const int turn = i >= 0 ? i / n : -((n - 1 - i) / n);
    const glm::dvec2 step =
        f.system == 0 ? glm::dvec2(0, repeat.size.y) : glm::dvec2(repeat.size.x, 0);
    return glm::dvec3(f.point[static_cast<std::size_t>(i - turn * n)]) +
           glm::dvec3(double(turn) * step, 0);
}

/// The curve between point i and the next one: Catmull-Rom.
glm::dvec3 curve(const FilamentRepeat &repeat, const Filament &f, int i, double t) {
    const glm::dvec3 a = periodic(repeat, f, i - 1), b = periodic(repeat, f, i),
                     c = periodic(repeat, f, i + 1), d = periodic(repeat, f, i + 2);
    return b +
           0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
}

/// Least distance between surfaces of warp and weft filaments as a share of the sum of their radii,
/// over all pairs of samples that lie in the same crossing or beside it.
double least_gap(const FilamentRepeat &repeat, const Weave &cloth) {
    constexpr int kBetween = 2;
    struct Sample {
        glm::dvec3 at;
        double radius;
    };
    const int ends = static_cast<int>(std::lround(repeat.size.x / cloth.warp.spacing()));
    const int picks = static_cast<int>(std::lround(repeat.size.y / cloth.weft.spacing()));
    std::map<std::pair<int, int>, std::vector<Sample>> warp;
    const auto each = [&](std::uint32_t system, auto visit) {
        for (const Filament &f : repeat.filaments)
            for (int i = 0; f.system == system && i < static_cast<int>(f.point.size()); ++i)
                for (int s = 0; s < kBetween; ++s)
                    visit(curve(repeat, f, i, s / double(kBetween)), double(f.radius));
    };
    // A sample is kept in each crossing that it lies in or near.
    const double near = 0.2;
    each(0, [&](glm::dvec3 p, double radius) {
        const int end = static_cast<int>(std::floor(p.x / cloth.warp.spacing()));
        const double pick = p.y / cloth.weft.spacing();
        for (int k = static_cast<int>(std::floor(pick - near)); k <= std::floor(pick + near); ++k)
            warp[{end, k}].push_back({p, radius});
    });
    double least = 1e300;
    each(1, [&](glm::dvec3 p, double radius) {
        const double end = p.x / cloth.warp.spacing();
        const int pick = static_cast<int>(std::floor(p.y / cloth.weft.spacing()));
        for (int k = static_cast<int>(std::floor(end - near)); k <= std::floor(end + near); ++k) {
            const int e = ((k % ends) + ends) % ends;
            const glm::dvec3 q = p + glm::dvec3((e - k) * cloth.warp.spacing(), 0, 0);
            for (int step = -1; step <= 1; ++step) {
                const auto found = warp.find({e, pick + step * picks});
                if (found == warp.end())
                    continue;
                const glm::dvec3 moved = q + glm::dvec3(0, step * repeat.size.y, 0);
                for (const Sample &w : found->second)
                    least = std::min(least, glm::distance(w.at, moved) / (w.radius + radius) - 1);
            }
        }
    });
    return least;
}

/// Mean height of a yarn's filaments at a crossing: index of its points there.
double mean_height(const FilamentRepeat &repeat, std::uint32_t system, int yarn, int place) {
    double sum = 0;
    int count = 0;
    for (const Filament &f : repeat.filaments)
        if (f.system == system && f.yarn == static_cast<std::uint32_t>(yarn)) {
            sum += f.point[static_cast<std::size_t>(place)].z;
            ++count;
        }
    return sum / count;
}

class Preset : public testing::TestWithParam<std::string> {
  protected:
    const Weave cloth_ = weave(GetParam());
    const FilamentRepeat repeat_ = build_filaments(cloth_);
    const WeaveReport report_ = report_weave(cloth_);
    const int points_ = GeometryOptions{}.points_per_crossing;
};

TEST_P(Preset, HasAllFilamentsAndTilesThePlane) {
    const int ends = static_cast<int>(std::lround(repeat_.size.x / cloth_.warp.spacing()));
    const int picks = static_cast<int>(std::lround(repeat_.size.y / cloth_.weft.spacing()));
    EXPECT_EQ(ends % cloth_.draft.ends, 0);
    EXPECT_EQ(picks % cloth_.draft.picks, 0);
    EXPECT_NEAR(repeat_.size.x, ends * cloth_.warp.spacing(), 1e-12);
    EXPECT_EQ(repeat_.filaments.size(), static_cast<std::size_t>(ends * cloth_.warp.filaments +
                                                                 picks * cloth_.weft.filaments));
    ASSERT_EQ(repeat_.optics.size(), 2u);
    for (const Filament &f : repeat_.filaments) {
        EXPECT_EQ(f.point.size(),
                  static_cast<std::size_t>(points_ * (f.system == 0 ? picks : ends)));
        EXPECT_EQ(f.turn.empty(), repeat_.optics[f.system].section == FilamentSection::round);
    }
}

// No step and no bend at the edge of the repeat is larger than inside it.
TEST_P(Preset, PathsGoOnIntoTheNextRepeat) {
    for (const Filament &f : repeat_.filaments) {
        const int n = static_cast<int>(f.point.size());
        const auto bend = [&](int i) {
            return glm::length(periodic(repeat_, f, i - 1) - 2.0 * periodic(repeat_, f, i) +
                               periodic(repeat_, f, i + 1));
        };
        double inside = 0, edge = 0, step = 0;
        for (int i = 2; i < n - 2; ++i) {
            inside = std::max(inside, bend(i));
            step =
                std::max(step, glm::distance(periodic(repeat_, f, i), periodic(repeat_, f, i + 1)));
        }
        for (int i = n - 2; i < n + 2; ++i)
            edge = std::max(edge, bend(i));
        ASSERT_LT(edge, std::max(3 * inside, 0.05 * step));
    }
}

TEST_P(Preset, YarnsCrossOnTheSideOfTheDraftAndTouch) {
    const double apart = (report_.warp_thickness + report_.weft_thickness) / 2;
    double closest = 1e300;
    for (int e = 0; e < cloth_.draft.ends; ++e)
        for (int p = 0; p < cloth_.draft.picks; ++p) {
            const double warp = mean_height(repeat_, 0, e, p * points_ + points_ / 2);
            const double weft = mean_height(repeat_, 1, p, e * points_ + points_ / 2);
            const double above = cloth_.draft.up(e, p) ? warp - weft : weft - warp;
            EXPECT_GT(above, 0.95 * apart) << e << " " << p;
            closest = std::min(closest, above);
        }
    EXPECT_LT(closest, 1.2 * apart);
}

TEST_P(Preset, NothingPassesThroughAnything) {
    EXPECT_GT(least_gap(repeat_, cloth_), -kTolerance);
    EXPECT_GT(report_.warp_weft_gap, -0.25e-6); // a twentieth of a filament
    EXPECT_LT(report_.warp_weft_gap, 2e-6);     // they touch
    EXPECT_GE(report_.neighbour_gap, 0);
    // The check sees a weft that is lifted by a third of a filament.
    FilamentRepeat wrong = repeat_;
    for (Filament &f : wrong.filaments)
        for (glm::vec3 &p : f.point)
            p.z += f.system == 1 ? 2 * f.radius / 3 : 0;
    EXPECT_LT(least_gap(wrong, cloth_), -2 * kTolerance);
}

// Within a yarn: circles that touch at most, where the yarn runs level (2.5 % for the arcs that a
// moving ring cuts).
TEST_P(Preset, FilamentsOfAYarnDoNotOverlap) {
    for (const std::uint32_t system : {0u, 1u}) {
        std::vector<const Filament *> yarn;
        for (const Filament &f : repeat_.filaments)
            if (f.system == system && f.yarn == 1)
                yarn.push_back(&f);
        for (std::size_t k = 0; k < yarn[0]->point.size(); k += 5)
            for (std::size_t a = 0; a < yarn.size(); ++a)
                for (std::size_t b = 0; b < a; ++b)
                    ASSERT_GT(glm::distance(yarn[a]->point[k], yarn[b]->point[k]),
                              2 * yarn[a]->radius * 0.999)
                        << system << " " << k << " " << a << " " << b;
    }
    EXPECT_GT(std::min(report_.warp_fill, report_.weft_fill), 0.5);
    EXPECT_LT(std::max(report_.warp_fill, report_.weft_fill), 0.75);
}

// Counts and weights as the presets tell them.
TEST_P(Preset, IsAsFineAndHeavyAsItsSourceSays) {
    struct Row {
        const char *name;
        double warp_decitex, weft_decitex, mass_per_m2;
    };
    constexpr double kMomme = 4.306e-3, kDenier = 1 / 0.9, kRaw = 0.77 * kDenier;
    const Row rows[] = {{"black polyester satin", 75 * kDenier, 75 * kDenier, 95e-3},
                        {"silk charmeuse", 42 * kRaw, 63 * kRaw, 16 * kMomme},
                        {"polyester taffeta", 75 * kDenier, 75 * kDenier, 65e-3},
                        {"silk habotai", 42 * kRaw, 42 * kRaw, 8 * kMomme},
                        {"twill lining", 84, 84, 75e-3},
                        {"shot silk", 42 * kRaw, 70 * kRaw, 43e-3}};
    const auto row = std::find_if(std::begin(rows), std::end(rows),
                                  [&](const Row &r) { return r.name == GetParam(); });
    ASSERT_NE(row, std::end(rows));
    EXPECT_NEAR(report_.warp_decitex / row->warp_decitex, 1, 0.02);
    EXPECT_NEAR(report_.weft_decitex / row->weft_decitex, 1, 0.02);
    EXPECT_NEAR(report_.mass_per_m2 / row->mass_per_m2, 1, 0.06);
}

TEST_P(Preset, IsCentredAndAsThickAsReported) {
    double low = 1e300, high = -1e300;
    for (const Filament &f : repeat_.filaments)
        for (const glm::vec3 &p : f.point) {
            low = std::min(low, double(p.z - f.radius));
            high = std::max(high, double(p.z + f.radius));
        }
    const double slack = 0.02 * report_.thickness;
    EXPECT_NEAR(high, report_.thickness / 2, slack);
    EXPECT_NEAR(low, -report_.thickness / 2, slack);
    EXPECT_LT(report_.thickness, 2.2 * (report_.warp_thickness + report_.weft_thickness));
    EXPECT_GT(report_.cover, 0.9);
    EXPECT_LE(report_.cover, 1);
    EXPECT_GT(report_.warp_crimp, 0);
    EXPECT_LT(report_.weft_crimp, 0.15);
}

INSTANTIATE_TEST_SUITE_P(All, Preset, testing::ValuesIn(weave_names()), [](const auto &row) {
    std::string name = row.param;
    std::replace(name.begin(), name.end(), ' ', '_');
    return name;
});

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
            level += std::abs(rise) < 0.02 * repeat.size.y / places;
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

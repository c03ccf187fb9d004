// Filaments of every preset: periodic, on the side that the draft says, never through each other.

#include "tsuya/lab/weave_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "lab/mean_height.h"

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
                        {"silk charmeuse", 42 * kRaw, 84 * kRaw, 19 * kMomme},
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

} // namespace
} // namespace tsuya::lab

// The near field of yarns: the mean over its places is the far field, for every pair of directions.

#include "tsuya/sdk/near_yarn.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"
#include "tsuya/lab/weave_face.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya::test {
namespace {

struct Pair {
    glm::vec3 light, viewer;
};

// Of these one in four has a light or a viewer near the horizon.
std::vector<Pair> random_pairs(int count) {
    Random random(17);
    std::vector<Pair> pairs;
    for (int i = 0; i < count; ++i) {
        Pair pair{random.direction(), random.direction()};
        for (glm::vec3 *const d : {&pair.light, &pair.viewer})
            if (random.number() < 0.13f) {
                d->z = 1e-3f * random.number() + 1e-6f;
                *d = glm::normalize(*d);
            }
        pairs.push_back(pair);
    }
    return pairs;
}

YarnLobes lobes_of(const std::string &name) {
    const Fabric fabric =
        read_fabric(std::filesystem::path(TSUYA_FABRICS) / (name + ".fabric.toml"));
    const auto *const views = find_specular<CarriedViews>(fabric);
    return fit_yarn_lobes(views->bard, f0_of(*views));
}

glm::dvec2 centre_of(const WeaveMap &map, int x, int y) {
    return map.repeat * glm::dvec2(x + 0.5, y + 0.5) / glm::dvec2(map.size[0], map.size[1]);
}

// What `see` is given: every place, at its middle.
template <class See> void for_each_place(const NearYarn &near, const WeaveMap &map, See see) {
    for (int y = 0; y < map.size[1]; ++y)
        for (int x = 0; x < map.size[0]; ++x)
            see(near.at(centre_of(map, x, y), 0));
}

// A weft that rises evenly by `most` at both ends of a float over half a crossing's width, and a
// warp beside it that lies level.
WeaveMap ramp(float most) {
    constexpr int kAlong = 64;
    WeaveMap map{.repeat = {1e-3, 1e-3}, .size = {kAlong, 2}, .threads = {1, 1}};
    for (const std::uint8_t system : {WeavePlace::kWeft, WeavePlace::kWarp})
        for (int i = 0; i < kAlong; ++i) {
            const float along = (static_cast<float>(i) + 0.5f) / kAlong;
            map.place.push_back({.system = system,
                                 .slope = system == WeavePlace::kWeft ? most * (2 * along - 1) : 0,
                                 .along = along});
        }
    return map;
}

YarnLobes even_slopes() {
    YarnLobes lobes{.roughness = 0.03};
    for (std::size_t axis = 0; axis < 2; ++axis)
        for (std::size_t k = 4; k < kYarnSlopes - 4; ++k)
            lobes.surface[axis][k] = 0.01;
    return lobes;
}

struct Cloth {
    const char *name, *weave;
};

class NearYarnOfCloth : public testing::TestWithParam<Cloth> {};

TEST_P(NearYarnOfCloth, HasTheFarFieldAsItsMean) {
    YarnLobes lobes = lobes_of(GetParam().name);
    lobes.pit = {0.3, 0.2}; // shadows in both systems, whatever was fitted
    const WeaveMap map = lab::face_of(lab::weave(GetParam().weave));
    const NearYarn near(lobes, 0.1, map, {.filament = 0.05});
    const std::vector<Pair> pairs = random_pairs(1000);
    struct Sum {
        glm::dvec2 surface{0}, square{0}, body{0}, half{0};
    };
    std::vector<Sum> sums(pairs.size());
    double even = 0;
    std::size_t seen = 0;
    const std::size_t places = map.place.size();
    for_each_place(near, map, [&](const NearPlace &place) {
        even += static_cast<double>(near.diffuse(place)) / static_cast<double>(places);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const glm::dvec2 surface = near.surface(place, pairs[i].light, pairs[i].viewer);
            ASSERT_GE(std::min(surface.x, surface.y), 0);
            ASSERT_TRUE(std::isfinite(surface.x + surface.y));
            sums[i].surface += surface;
            sums[i].square += surface * surface;
            if (2 * seen < places)
                sums[i].half += surface;
            if (i < 100)
                sums[i].body += glm::dvec2(near.body(place, pairs[i].light, pairs[i].viewer));
        }
        ++seen;
    });
    double worst = 0, worst_body = 0, worst_half = 0, variance = 0;
    const auto off = [&](const glm::dvec2 &sum, double of) {
        const glm::dvec2 mean = sum / (of * static_cast<double>(places));
        return std::max(std::abs(mean.x - 1), std::abs(mean.y - 1));
    };
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        worst = std::max(worst, off(sums[i].surface, 1));
        worst_half = std::max(worst_half, off(sums[i].half, 0.5));
        variance += sums[i].square.x / static_cast<double>(places) - 1;
        if (i < 100)
            worst_body = std::max(worst_body, off(sums[i].body, 1));
    }
    EXPECT_LT(worst, 1e-5);
    EXPECT_LT(worst_body, 1e-5);
    EXPECT_NEAR(even, 1, 1e-5);
    // Controls: half of the places have another mean, and places differ
    EXPECT_GT(worst_half, 1e-2);
    EXPECT_GT(variance / static_cast<double>(pairs.size()), 0.3);
}

TEST_P(NearYarnOfCloth, IsReciprocalAtEveryPlace) {
    YarnLobes lobes = lobes_of(GetParam().name);
    lobes.pit = {0.3, 0.2};
    const WeaveMap map = lab::face_of(lab::weave(GetParam().weave), 8);
    const NearYarn near(lobes, 0.1, map, {});
    const std::vector<Pair> pairs = random_pairs(100);
    for_each_place(near, map, [&](const NearPlace &place) {
        for (const Pair &pair : pairs) {
            const glm::vec2 there = near.surface(place, pair.light, pair.viewer),
                            back = near.surface(place, pair.viewer, pair.light);
            ASSERT_NEAR(there.x, back.x, 1e-6f * std::max(there.x, 1.0f));
            ASSERT_NEAR(there.y, back.y, 1e-6f * std::max(there.y, 1.0f));
        }
    });
}

INSTANTIATE_TEST_SUITE_P(Cloths, NearYarnOfCloth,
                         testing::Values(Cloth{"black_satin", "black polyester satin"},
                                         Cloth{"black_charmeuse", "silk charmeuse"},
                                         Cloth{"black_taffeta", "polyester taffeta"},
                                         Cloth{"black_lining", "twill lining"}),
                         [](const auto &of) { return std::string(of.param.name); });

// The steeper a yarn lies at a place, the steeper are the filaments that the place has.
TEST(NearYarn, GivesSteepPlacesTheSteepFilaments) {
    const WeaveMap map = ramp(0.3f);
    const NearYarn near(even_slopes(), 0.05, map, {.filament = 0});
    // Normals of filaments that rise at a slope lean the other way
    const auto at_slope = [&](int x, double slope) {
        const glm::vec3 half(-std::sin(slope), 0, std::cos(slope));
        return near.surface(near.at(centre_of(map, x, 0), 0), half, half).x;
    };
    EXPECT_GT(at_slope(62, 0.6), 5 * at_slope(32, 0.6));
    EXPECT_GT(at_slope(32, 0.0), 5 * at_slope(62, 0.0));
    EXPECT_GT(at_slope(1, -0.6), 5 * at_slope(62, -0.6));
    EXPECT_LT(at_slope(62, -0.6), 0.01f);
}

TEST(NearYarn, ShowsOneSystemAtAPlace) {
    const WeaveMap map = ramp(0.2f);
    const NearYarn near(even_slopes(), 0.05, map, {});
    const glm::vec3 up(0, 0, 1);
    EXPECT_EQ(near.surface(near.at(centre_of(map, 20, 0), 0), up, up).y, 0);
    EXPECT_EQ(near.surface(near.at(centre_of(map, 20, 1), 0), up, up).x, 0);
    EXPECT_GT(near.surface(near.at(centre_of(map, 20, 1), 0), up, up).y, 0);
}

// In a pit the wall at the far end of the float is on the side of the light.
TEST(NearYarn, PutsTheEndOfAFloatTowardsALowLightInShadow) {
    YarnLobes lobes = even_slopes();
    lobes.pit = {0.4, 0};
    const WeaveMap map = ramp(0); // all places are alike but for where on the float they are
    const NearYarn near(lobes, 0.05, map, {.filament = 0});
    const glm::vec3 light = glm::normalize(glm::vec3(1, 0, 1)), viewer(0, 0, 1);
    const auto at = [&](int x, const glm::vec3 &from) {
        return near.surface(near.at(centre_of(map, x, 0), 0), from, viewer).x;
    };
    EXPECT_GT(at(10, light), 1.5f * at(60, light));
    EXPECT_GT(at(50, light * glm::vec3(-1, 1, 1)), 1.5f * at(3, light * glm::vec3(-1, 1, 1)));
}

TEST(NearYarn, FadesIntoTheFarFieldByItsFootprint) {
    const WeaveMap map = ramp(0.2f);
    const NearYarn near(even_slopes(), 0.05, map, {});
    const glm::dvec2 spot = centre_of(map, 5, 0);
    EXPECT_FLOAT_EQ(near.far_from(), 2e-3f);
    EXPECT_EQ(near.at(spot, 0.49e-3f).near, 1);
    EXPECT_EQ(near.at(spot, 2.01e-3f).near, 0);
    const glm::vec3 light = glm::normalize(glm::vec3(0.2, 0.3, 1)), up(0, 0, 1);
    const glm::vec2 whole = near.surface(near.at(spot, 0), light, up);
    const NearPlace between = near.at(spot, 1e-3f);
    EXPECT_GT(between.near, 0.3f);
    EXPECT_LT(between.near, 0.9f);
    const glm::vec2 mixed = near.surface(between, light, up);
    EXPECT_NEAR(mixed.x, 1 + between.near * (whole.x - 1), 1e-5);
    EXPECT_NEAR(mixed.y, 1 - between.near, 1e-6);
}

// Rows of what is seen along the warp's float at 16 x 16 spots a repeat, over some repeats.
double correlation(const NearYarn &near, const WeaveMap &map, int lag) {
    constexpr int kSpots = 16, kRepeats = 24;
    const glm::vec3 light = glm::normalize(glm::vec3(0.1, 0.2, 1)), viewer(0, 0, 1);
    double sum = 0, square = 0, product = 0;
    for (int y = 0; y < 4 * kSpots; ++y) {
        std::vector<double> row;
        for (int x = 0; x < kRepeats * kSpots; ++x) {
            const glm::dvec2 spot = map.repeat * glm::dvec2(x + 0.5, y + 0.5) / double(kSpots);
            const glm::vec2 seen = near.surface(near.at(spot, 0), light, viewer);
            row.push_back(static_cast<double>(seen.x + 2 * seen.y));
        }
        const std::size_t n = row.size(), step = static_cast<std::size_t>(lag * kSpots);
        for (std::size_t i = 0; i < n; ++i) {
            sum += row[i] / static_cast<double>(n);
            square += row[i] * row[i] / static_cast<double>(n);
            if (i + step < n)
                product += row[i] * row[i + step] / static_cast<double>(n - step);
        }
    }
    const double rows = 4 * kSpots, mean = sum / rows;
    return (product / rows - mean * mean) / (square / rows - mean * mean);
}

// Repeats of uneven threads differ.
TEST(NearYarn, HasNoRepeatThatIsLikeTheNext) {
    const WeaveMap map = lab::face_of(lab::weave("black polyester satin"));
    const NearYarn even(even_slopes(), 0.05, map, {}),
        uneven(even_slopes(), 0.05, map, {.thickness = 0.08});
    for (const int lag : {2, 4, 8}) {
        EXPECT_NEAR(correlation(even, map, lag), 1, 0.01); // control
        EXPECT_LT(correlation(uneven, map, lag), 0.9) << lag;
    }
}

// A system that is not on the face has no places, and what the far field has of it stays.
TEST(NearYarn, KeepsASystemThatIsNeverOnTheFace) {
    WeaveMap map = ramp(0.2f);
    for (WeavePlace &place : map.place)
        place.system = WeavePlace::kWarp;
    const NearYarn near(even_slopes(), 0.05, map, {});
    const glm::vec3 up(0, 0, 1);
    EXPECT_EQ(near.surface(near.at(centre_of(map, 20, 0), 0), up, up).x, 1);
    EXPECT_EQ(near.crowding(0), 0);
    EXPECT_NEAR(near.crowding(1), 0.41, 1e-6);
}

TEST(NearYarn, RefusesMapsThatBreakTheirRules) {
    const auto where = [](const WeaveMap &map, const Irregularity &irregularity) {
        try {
            const NearYarn near(even_slopes(), 0.05, map, irregularity);
        } catch (const Error &error) {
            return error.problems().front().where;
        }
        return std::string("nothing thrown");
    };
    WeaveMap map = ramp(0.2f);
    map.place.pop_back();
    EXPECT_EQ(where(map, {}), "weave.place");
    map = ramp(0.2f);
    map.place[3].thread = 1;
    EXPECT_EQ(where(map, {}), "weave.place");
    map = ramp(0.2f);
    map.repeat.x = 0;
    EXPECT_EQ(where(map, {}), "weave.repeat");
    EXPECT_EQ(where(ramp(0.2f), {.thickness = 0.5}), "weave.irregularity.thickness");
    EXPECT_EQ(where(ramp(0.2f), {.slubs_per_m = 20, .slub_length = 0.06}),
              "weave.irregularity.slub_length");
}

} // namespace
} // namespace tsuya::test

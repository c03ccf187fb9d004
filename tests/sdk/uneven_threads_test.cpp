#include "tsuya/sdk/detail/uneven_threads.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "sdk/hemisphere_quadrature.h"

namespace tsuya::test {
namespace {

WeaveMap satin_sized() {
    return {.repeat = {5 * 1.3e-4, 5 * 2.9e-4}, .size = {5, 5}, .threads = {5, 5}};
}

// Where the thread changes, along a line from `from` to `to`: by halving, to the rounding of
// doubles. `thread` of a place of the line is a whole number.
template <class Thread>
std::vector<double> edges_between(const Thread &thread, double from, double to, double step) {
    std::vector<double> edges;
    for (double x = from; x < to; x += step) {
        double low = x, high = x + step;
        if (thread(low) == thread(high))
            continue;
        const int before = thread(low);
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (thread(middle) == before ? low : high) = middle;
        }
        edges.push_back(high);
    }
    return edges;
}

TEST(UnevenThreads, OfNoVarianceAreTheRepeat) {
    const WeaveMap map = satin_sized();
    const UnevenThreads threads(map, {});
    const UnevenThreads::Spot spot = threads.at({-0.25 * 1.3e-4, 7.5 * 2.9e-4});
    EXPECT_NEAR(spot.place.x, 4.75, 1e-5);
    EXPECT_NEAR(spot.place.y, 2.5, 1e-5);
    EXPECT_EQ(spot.density, 1);
    EXPECT_NEAR(threads.period().y, map.repeat.y, 1e-12);
}

// What is darker by as much as it is wider brings the same, thread by thread; and all threads of
// a row together are as wide as even ones.
TEST(UnevenThreads, BringTheMeanOfTheRepeatOverTheirPeriod) {
    const WeaveMap map = satin_sized();
    const UnevenThreads threads(map, {.thickness = 0.08});
    const double spacing = map.spacing().x, period = threads.period().x, y = 1e-4;
    EXPECT_GT(period, 200 * map.repeat.x);
    const auto thread = [&](double x) { return static_cast<int>(threads.at({x, y}).place.x); };
    const std::vector<double> edges =
        edges_between(thread, 0, 2 * period - 0.15 * spacing, 0.1 * spacing);
    const auto count = static_cast<std::size_t>(std::lround(period / spacing));
    ASSERT_EQ(edges.size(), 2 * count - 1);
    EXPECT_NEAR(edges[count - 1], period, 1e-9 * period);
    double square = 0;
    for (std::size_t i = 1; i < count; ++i) {
        const double width = edges[i] - edges[i - 1], middle = 0.5 * (edges[i] + edges[i - 1]);
        const UnevenThreads::Spot spot = threads.at({middle, y});
        EXPECT_NEAR(spot.place.x - std::floor(spot.place.x), 0.5, 1e-4);
        EXPECT_EQ(static_cast<int>(spot.place.x), static_cast<int>(i % 5));
        EXPECT_NEAR(spot.density * width, threads.at({edges[0] * 0.5, y}).density * edges[0],
                    2e-6 * spacing);
        square += std::pow(width / spacing - 1, 2);
    }
    EXPECT_NEAR(std::sqrt(square / static_cast<double>(count)), 0.08, 0.008);
}

// Picks about a slub give it the room: along any line across, a group of them is as wide as ever.
TEST(UnevenThreads, SlubsTakeTheirRoomFromThePicksBeside) {
    const WeaveMap map = satin_sized();
    const UnevenThreads threads(map, {.slubs_per_m = 20, .slub_length = 0.01, .slub_gain = 1.5});
    const double spacing = map.spacing().y;
    Random random(3);
    double widest = 0;
    for (int line = 0; line < 200; ++line) {
        const double x = 0.3 * static_cast<double>(random.number());
        const auto thread = [&](double y) { return static_cast<int>(threads.at({x, y}).place.y); };
        const std::vector<double> edges = edges_between(thread, 0, 8.5 * spacing, 0.02 * spacing);
        ASSERT_EQ(edges.size(), 8u);
        EXPECT_NEAR(edges.back(), 8 * spacing, 1e-9);
        double low = 0;
        for (const double edge : edges) {
            const UnevenThreads::Spot spot = threads.at({x, 0.5 * (low + edge)});
            EXPECT_NEAR(spot.density * (edge - low), spacing, 1e-5 * spacing);
            widest = std::max(widest, (edge - low) / spacing);
            low = edge;
        }
    }
    EXPECT_GT(widest, 1.8);
}

constexpr double kSlubLength = 0.012;

struct SlubsSeen {
    double number = 0;       // in a metre of a pick
    double above_half_m = 0; // what of one is more than half its height
};

// Walks along the picks of one group, whose thinnest has no slub, and looks at where they are wide.
SlubsSeen slubs_seen(double slubs_per_m) {
    const WeaveMap map = satin_sized();
    constexpr double kGain = 1.5, kStep = 1e-3, kWalk = 2;
    constexpr std::size_t kPicks = 8;
    const UnevenThreads threads(
        map, {.slubs_per_m = slubs_per_m, .slub_length = kSlubLength, .slub_gain = kGain});
    const double spacing = map.spacing().y;
    std::vector<bool> inside(kPicks);
    int slubs = 0, above_half = 0;
    for (double x = 0; x < kWalk; x += kStep) {
        const auto thread = [&](double y) { return static_cast<int>(threads.at({x, y}).place.y); };
        const std::vector<double> edges = edges_between(thread, 0, 8.1 * spacing, 0.1 * spacing);
        if (edges.size() != kPicks)
            throw std::logic_error("a pick was missed");
        std::vector<double> width{edges[0]};
        for (std::size_t i = 1; i < kPicks; ++i)
            width.push_back(edges[i] - edges[i - 1]);
        const double thinnest = *std::min_element(width.begin(), width.end());
        for (std::size_t i = 0; i < kPicks; ++i) {
            const double swelling = width[i] / thinnest - 1;
            slubs += swelling > 0.05 * kGain && !inside[i];
            inside[i] = swelling > 0.05 * kGain;
            above_half += swelling > 0.5 * kGain;
        }
    }
    return {slubs / (kWalk * kPicks), above_half * kStep / slubs};
}

TEST(UnevenThreads, HaveAsManySlubsAsLongAsAsked) {
    const SlubsSeen seen = slubs_seen(20);
    EXPECT_NEAR(seen.number / 20, 1, 0.1);
    // A cosine squared is above half its height over half its length
    EXPECT_NEAR(seen.above_half_m / (0.5 * kSlubLength), 1, 0.1);
    EXPECT_GT(std::abs(slubs_seen(15).number / 20 - 1), 0.1); // negative control
}

} // namespace
} // namespace tsuya::test

#include "tsuya/lab/lamp_drift.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

TEST(LampDrift, IsLinearBetweenReadingsOfOneLighting) {
    const LampDrift lamp({{.time_s = 200, .rate = 110, .strike = 1},
                          {.time_s = 100, .rate = 100, .strike = 1},
                          {.time_s = 300, .rate = 50, .strike = 2}},
                         0.5, 0);
    EXPECT_DOUBLE_EQ(lamp.at(125, 1)->rate, 102.5);
    EXPECT_DOUBLE_EQ(lamp.at(0, 1)->rate, 100);
    EXPECT_DOUBLE_EQ(lamp.at(250, 1)->rate, 110) << "not towards another lighting";
    EXPECT_DOUBLE_EQ(lamp.at(250, 2)->rate, 50);
    EXPECT_FALSE(lamp.at(125, 3));
}

TEST(LampDrift, TellsJumps) {
    const LampDrift lamp(
        {{.time_s = 0, .rate = 100}, {.time_s = 10, .rate = 101}, {.time_s = 20, .rate = 95}}, 0.02,
        0);
    EXPECT_FALSE(lamp.at(5, 0)->jump);
    EXPECT_TRUE(lamp.at(15, 0)->jump);
    EXPECT_FALSE(lamp.at(25, 0)->jump) << "after the last there is nothing to compare";
}

TEST(LampDrift, SigmaHoldsNoiseAndFlicker) {
    const std::vector<WhiteReading> readings{{.time_s = 0, .rate = 100, .sigma = 0.3},
                                             {.time_s = 10, .rate = 100, .sigma = 0.4}};
    EXPECT_NEAR(LampDrift(readings, 1, 0).at(5, 0)->sigma, 0.25, 1e-12);
    EXPECT_NEAR(LampDrift(readings, 1, 0).at(0, 0)->sigma, 0.3, 1e-12);
    EXPECT_NEAR(LampDrift(readings, 1, 0.01).at(5, 0)->sigma, std::hypot(0.25, std::sqrt(1.5)),
                1e-12);
}

TEST(LampDrift, FlickerIsFoundBesideDriftAndNoise) {
    std::mt19937 random(11);
    std::normal_distribution<double> normal;
    std::vector<std::vector<WhiteReading>> lists(20);
    for (auto &list : lists)
        for (int i = 0; i < 50; ++i)
            list.push_back(
                {.time_s = 60.0 * i,
                 .rate = 100 * (1 + 4e-4 * i) * (1 + 0.002 * normal(random)) + 0.1 * normal(random),
                 .sigma = 0.1});
    EXPECT_NEAR(flicker_of(lists).value(), 0.002, 0.0002);
    for (auto &list : lists)
        for (WhiteReading &reading : list)
            reading.sigma = 0;
    EXPECT_GT(flicker_of(lists).value(), 0.0021) << "noise that is not told is taken for flicker";
    EXPECT_FALSE(flicker_of({{{.time_s = 0, .rate = 1}, {.time_s = 1, .rate = 1}}}));
}

} // namespace
} // namespace tsuya::lab

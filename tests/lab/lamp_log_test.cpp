#include "tsuya/lab/lamp_log.h"

#include "samples/scratch.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

using scene::Scratch;

TEST(LampLog, CountsStrikesAndHoursOverRestarts) {
    const Scratch scratch;
    Moment now{.boot = "a", .boottime_s = 100, .time_s = 1e9};
    const Moments moments = [&] { return now; };
    {
        LampLog log(scratch / "lamp.log", "L1", moments);
        EXPECT_FALSE(log.state().last);
        log.light();
        now.boottime_s += 1800;
        now.time_s -= 5000; // someone sets the clock
        EXPECT_EQ(log.hours_now(), 0.5);
        log.put_out();
    }
    LampLog(scratch / "lamp.log", "other", moments).light();
    LampLog log(scratch / "lamp.log", "L1", moments);
    EXPECT_FALSE(log.state().lit);
    EXPECT_EQ(log.state().strikes, 1);
    EXPECT_EQ(log.state().hours, 0.5);
    EXPECT_EQ(log.light().strikes, 2);
}

TEST(LampLog, ALampThatIsLitInTheLogWentOffNow) {
    const Scratch scratch;
    Moment now{.boot = "a", .boottime_s = 100, .time_s = 1e9};
    const Moments moments = [&] { return now; };
    LampLog(scratch / "lamp.log", "L1", moments).light();
    now = {.boot = "b", .boottime_s = 20, .time_s = 1e9 + 3600};
    {
        const LampLog log(scratch / "lamp.log", "L1", moments);
        EXPECT_FALSE(log.state().lit);
        EXPECT_EQ(restrike_left(log.state(), Seconds(900), now), Seconds(900));
    }
    now.boottime_s += 800;
    const LampLog again(scratch / "lamp.log", "L1", moments);
    EXPECT_EQ(restrike_left(again.state(), Seconds(900), now), Seconds(100));
}

TEST(LampLog, TheRestrikeCountsOverRestartsAndClocks) {
    const LampState state{.strikes = 1,
                          .last = Moment{.boot = "a", .boottime_s = 1000, .time_s = 1e9}};
    const auto left = [&](const Moment &now) {
        return restrike_left(state, Seconds(900), now).count();
    };
    EXPECT_EQ(left({.boot = "a", .boottime_s = 1300, .time_s = 0}), 600);
    EXPECT_EQ(left({.boot = "a", .boottime_s = 1900, .time_s = 0}), 0);
    EXPECT_EQ(left({.boot = "b", .boottime_s = 5, .time_s = 1e9 + 300}), 600);
    EXPECT_EQ(left({.boot = "b", .boottime_s = 5, .time_s = 1e9 + 3000}), 0);
    EXPECT_EQ(left({.boot = "b", .boottime_s = 5, .time_s = 1e9 - 10}), 900);
    EXPECT_EQ(restrike_left({}, Seconds(900), {}).count(), 0);
}

TEST(LampLog, TheComputersOwnMomentGoesOn) {
    const Moment first = moment_now(), second = moment_now();
    EXPECT_EQ(first.boot, second.boot);
    EXPECT_EQ(first.boot.size(), 36u);
    EXPECT_GE(second.boottime_s, first.boottime_s);
    EXPECT_GT(first.time_s, 1.6e9);
}

} // namespace
} // namespace tsuya::lab

#include "tsuya/lab/clock.h"

#include "tsuya/lab/simulated_line.h"

#include <gtest/gtest.h>

#include <thread>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;

TEST(SteadyClock, NeverWakesBeforeTheDeadline) {
    SteadyClock clock;
    const std::atomic<bool> stop{false};
    const auto deadline = clock.now() + 25ms; // longer than two slices
    EXPECT_TRUE(clock.sleep_until(deadline, &stop));
    EXPECT_GE(clock.now(), deadline);
    EXPECT_TRUE(clock.sleep_until(deadline + 1ms, nullptr));
    EXPECT_TRUE(clock.sleep_until(0ns, &stop)); // long past
}

// An hour's sleep ends: the test's own time limit is the only clock that judges it.
TEST(SteadyClock, AStopOfAnotherThreadEndsASleep) {
    SteadyClock clock;
    std::atomic<bool> stop{false};
    const auto start = clock.now();
    std::thread other([&] { stop = true; });
    EXPECT_FALSE(clock.sleep_until(start + 1h, &stop));
    other.join();
    EXPECT_LT(clock.now(), start + 1h);
}

TEST(SteadyClock, AStopThatIsSetWinsOverADeadlineThatIsPast) {
    SteadyClock clock;
    const std::atomic<bool> stop{true};
    EXPECT_FALSE(clock.sleep_until(0ns, &stop));
}

TEST(VirtualClock, RunsEventsInOrderAtTheirTimes) {
    VirtualClock clock;
    std::vector<std::chrono::nanoseconds> times;
    for (const auto time : {30ms, 10ms, 20ms, 50ms})
        clock.at(time, [&] { times.push_back(clock.now()); });
    EXPECT_TRUE(clock.sleep_until(40ms, nullptr));
    EXPECT_EQ(times, (std::vector<std::chrono::nanoseconds>{10ms, 20ms, 30ms}));
    EXPECT_EQ(clock.now(), 40ms);
    clock.advance(10ms);
    EXPECT_EQ(times.back(), 50ms);
}

TEST(VirtualClock, NeverGoesBack) {
    VirtualClock clock;
    clock.advance(10ms);
    EXPECT_TRUE(clock.sleep_until(5ms, nullptr));
    EXPECT_EQ(clock.now(), 10ms);
    clock.at(1ms, [&] { EXPECT_EQ(clock.now(), 10ms); });
    EXPECT_TRUE(clock.sleep_until(11ms, nullptr));
}

TEST(VirtualClock, StopsAtTheEventThatSetsTheFlag) {
    VirtualClock clock;
    std::atomic<bool> stop{false};
    clock.at(3ms, [&] { stop = true; });
    EXPECT_FALSE(clock.sleep_until(5ms, &stop));
    EXPECT_EQ(clock.now(), 3ms);
}

TEST(SimulatedLine, RecordsChangesOnly) {
    VirtualClock clock;
    SimulatedLine line("lamp", clock);
    line.set(false);
    clock.advance(2ms);
    line.set(true);
    line.set(true);
    clock.advance(3ms);
    line.set(false);
    EXPECT_EQ(line.transitions(), (std::vector<Transition>{{2ms, true}, {5ms, false}}));
}

TEST(SimulatedInput, WaitsForTheEdgeThatIsAskedFor) {
    VirtualClock clock;
    SimulatedInput line("interlock", clock, true);
    clock.at(3ms, [&] { line.change(true); }); // no change
    clock.at(5ms, [&] { line.change(false); });
    clock.at(9ms, [&] { line.change(true); });
    EXPECT_EQ(line.wait(Edge::to_active, 1s, nullptr), (EdgeEvent{9ms, true}));
    EXPECT_EQ(clock.now(), 9ms);
    clock.at(20ms, [&] { line.change(false); });
    EXPECT_EQ(line.wait(Edge::any, 15ms, nullptr), std::nullopt);
    EXPECT_EQ(clock.now(), 15ms);
    clock.advance(10ms);
    EXPECT_FALSE(line.active());
    EXPECT_EQ(line.wait(Edge::any, 0ms, nullptr), (EdgeEvent{20ms, false})); // came before the call
}

TEST(SimulatedInput, AStopEndsTheWait) {
    VirtualClock clock;
    SimulatedInput line("busy", clock);
    std::atomic<bool> stop{false};
    clock.at(3s, [&] { stop = true; });
    EXPECT_EQ(line.wait(Edge::any, 1h, &stop), std::nullopt);
    EXPECT_LE(clock.now(), 3s + SteadyClock::kStopLatency);
}

} // namespace
} // namespace tsuya::lab

#include "tsuya/lab/pulse.h"

#include "lab/failing_line.h"
#include "tsuya/lab/off_guard.h"
#include "tsuya/lab/pulse_job.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

#include <gtest/gtest.h>

#include <tuple>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;

struct SimulatedRig {
    VirtualClock clock;
    SimulatedLine lamp{"lamp", clock};
    SimulatedLine shutter{"shutter", clock};
    Rig rig{.shutter = shutter, .clock = clock, .lamp = &lamp};

    void expect_off() const {
        EXPECT_FALSE(lamp.active());
        EXPECT_FALSE(shutter.active());
    }
};

/// 3 pulses of 20 ms each 100 ms, after a warm-up of 10 s.
PulseTrain three_pulses() { return {.width = 20ms, .period = 100ms, .count = 3, .warm_up = 10s}; }

TEST(Pulses, KeepTheirTimesExactly) {
    SimulatedRig simulated;
    const PulseReport report = run_pulses(three_pulses(), simulated.rig);
    const std::vector<Transition> shutter{{10000ms, true},  {10020ms, false}, {10100ms, true},
                                          {10120ms, false}, {10200ms, true},  {10220ms, false}};
    EXPECT_EQ(simulated.shutter.transitions(), shutter);
    const std::vector<Transition> lamp{{0ms, true}, {10220ms, false}};
    EXPECT_EQ(simulated.lamp.transitions(), lamp);
    ASSERT_EQ(report.pulses.size(), 3u);
    EXPECT_EQ(report.pulses[2].opened, 200ms);
    EXPECT_EQ(report.pulses[2].closed, 220ms);
    EXPECT_EQ(report.mean_width, 20ms);
    EXPECT_EQ(report.largest_late, 0ns);
}

TEST(Pulses, AreExactAtTheLimits) {
    SimulatedRig simulated;
    const PulseTrain train{.width = 1ns, .period = 1h, .count = 1'000'000};
    const PulseReport report = run_pulses(train, simulated.rig);
    EXPECT_EQ(report.pulses.back().opened, 999'999h);
    EXPECT_EQ(report.mean_width, 1ns);
    EXPECT_EQ(simulated.shutter.transitions().size(), 2'000'000u);
}

TEST(Pulses, LatenessDoesNotAddUp) {
    SimulatedRig simulated;
    simulated.clock.at(25ms, [&] { simulated.clock.advance(30ms); }); // the second opens 5 ms late
    const PulseReport report =
        run_pulses({.width = 20ms, .period = 50ms, .count = 4, .tolerance = 5ms},
                   {.shutter = simulated.shutter, .clock = simulated.clock});
    EXPECT_EQ(report.pulses[0].closed, 20ms);
    EXPECT_EQ(report.pulses[1].opened, 55ms);
    EXPECT_EQ(report.pulses[1].closed, 70ms);
    EXPECT_EQ(report.pulses[3].opened, 150ms);
}

TEST(Pulses, ReportLateness) {
    SimulatedRig simulated;
    simulated.clock.at(95ms, [&] { simulated.clock.advance(8ms); }); // the second opens 3 ms late
    const PulseReport report =
        run_pulses({.width = 20ms, .period = 100ms, .count = 2, .tolerance = 3ms}, simulated.rig);
    EXPECT_EQ(report.pulses[1].opened, 103ms);
    EXPECT_EQ(report.pulses[1].closed, 120ms);
    EXPECT_EQ(report.largest_late, 3ms);
    EXPECT_EQ(report.mean_late, 750us); // 3 ms over two openings and two closings
    EXPECT_EQ(report.mean_width, 18500us);
}

TEST(Pulses, WithoutALampMoveTheShutterOnly) {
    SimulatedRig simulated;
    run_pulses(three_pulses(), {.shutter = simulated.shutter, .clock = simulated.clock});
    EXPECT_TRUE(simulated.lamp.transitions().empty());
    EXPECT_EQ(simulated.shutter.transitions().size(), 6u);
}

TEST(Pulses, TellTheirProgress) {
    SimulatedRig simulated;
    std::vector<double> told;
    run_pulses(three_pulses(), simulated.rig,
               {.report = [&](std::string_view, double fraction) { told.push_back(fraction); }});
    EXPECT_EQ(told, (std::vector<double>{0.0, 1.0 / 3, 2.0 / 3, 1.0}));
}

class PulsesStopped : public testing::TestWithParam<std::chrono::nanoseconds> {};

TEST_P(PulsesStopped, EndAtOnceWithEverythingOff) {
    SimulatedRig simulated;
    std::atomic<bool> stop{false};
    simulated.clock.at(GetParam(), [&] { stop = true; });
    EXPECT_THROW(run_pulses(three_pulses(), simulated.rig, {.stop = &stop}), Interrupted);
    EXPECT_EQ(simulated.clock.now(), GetParam());
    simulated.expect_off();
    EXPECT_EQ(simulated.lamp.transitions().back(), (Transition{GetParam(), false}));
}

// In the warm-up, in the middle of the second pulse, between pulses, at the opening and at the
// closing of a pulse.
INSTANTIATE_TEST_SUITE_P(AnyTime, PulsesStopped,
                         testing::Values(5s, 10110ms, 10150ms, 10100ms, 10220ms));

TEST(Pulses, StoppedBeforeTheyStartMoveNothing) {
    SimulatedRig simulated;
    const std::atomic<bool> stop{true};
    EXPECT_THROW(run_pulses(three_pulses(), simulated.rig, {.stop = &stop}), Interrupted);
    EXPECT_TRUE(simulated.lamp.transitions().empty());
    EXPECT_TRUE(simulated.shutter.transitions().empty());
}

TEST(Pulses, AnExceptionOfTheCallerLeavesEverythingOff) {
    SimulatedRig simulated;
    const Progress progress{.report = [](std::string_view, double fraction) {
        if (fraction > 0.5)
            throw std::domain_error("the caller's own");
    }};
    EXPECT_THROW(run_pulses(three_pulses(), simulated.rig, progress), std::domain_error);
    simulated.expect_off();
    EXPECT_EQ(simulated.shutter.transitions().size(), 4u);
}

TEST(Pulses, AShutterThatFailsToOpenLeavesTheLampOff) {
    SimulatedRig simulated;
    FailingLine shutter("shutter", simulated.clock, 3);
    try {
        run_pulses(three_pulses(),
                   {.shutter = shutter, .clock = simulated.clock, .lamp = &simulated.lamp});
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 1u);
        EXPECT_EQ(error.problems()[0].where, "shutter");
        EXPECT_EQ(error.problems()[0].what, "the wire is broken");
    }
    EXPECT_FALSE(simulated.lamp.active());
    EXPECT_FALSE(shutter.active());
}

TEST(Pulses, AShutterThatFailsToCloseIsTriedAgain) {
    SimulatedRig simulated;
    FailingLine shutter("shutter", simulated.clock, 2, OffGuard::kAttempts);
    EXPECT_THROW(
        run_pulses(three_pulses(),
                   {.shutter = shutter, .clock = simulated.clock, .lamp = &simulated.lamp}),
        Error);
    EXPECT_FALSE(shutter.active());
    EXPECT_FALSE(simulated.lamp.active());
}

TEST(Pulses, ALineThatStaysOnIsSaidBesideTheCause) {
    SimulatedRig simulated;
    FailingLine lamp("lamp", simulated.clock, 2, 1000);
    FailingLine shutter("shutter", simulated.clock, 3);
    try {
        run_pulses(three_pulses(), {.shutter = shutter, .clock = simulated.clock, .lamp = &lamp});
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "shutter");
        EXPECT_EQ(error.problems()[1].where, "lamp");
        EXPECT_TRUE(error.problems()[1].what.starts_with("may still be on"));
    }
    EXPECT_FALSE(shutter.active());
}

TEST(Pulses, ALampThatStaysOnAfterAGoodTrainIsAnError) {
    SimulatedRig simulated;
    FailingLine lamp("lamp", simulated.clock, 2, 1000);
    EXPECT_THROW(
        run_pulses(three_pulses(),
                   {.shutter = simulated.shutter, .clock = simulated.clock, .lamp = &lamp}),
        Error);
    EXPECT_FALSE(simulated.shutter.active());
}

TEST(Pulses, APulseThatWasMissedIsAnError) {
    SimulatedRig simulated;
    simulated.clock.at(10050ms, [&] { simulated.clock.advance(70ms); });
    try {
        run_pulses(three_pulses(), simulated.rig);
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "shutter");
        EXPECT_NE(error.problems()[0].what.find("pulse 2 of 3"), std::string::npos);
    }
    simulated.expect_off();
}

/// A line whose hardware takes time.
class SlowLine final : public OutputLine {
  public:
    SlowLine(VirtualClock &clock, std::chrono::nanoseconds opening,
             std::chrono::nanoseconds closing)
        : clock_(clock), line_("shutter", clock), opening_(opening), closing_(closing) {}

    void set(bool active) override {
        if (active)
            clock_.advance(opening_);
        line_.set(active);
        if (!active)
            clock_.advance(closing_);
    }
    const std::string &name() const override { return line_.name(); }
    bool active() const { return line_.active(); }

  private:
    VirtualClock &clock_;
    SimulatedLine line_;
    std::chrono::nanoseconds opening_, closing_;
};

/// What a train with a slow shutter ends with; fails if it is no error.
PulsesFailed failure_of(const PulseTrain &train, OutputLine &shutter, VirtualClock &clock) {
    try {
        run_pulses(train, {.shutter = shutter, .clock = clock});
    } catch (const PulsesFailed &error) {
        return error;
    }
    ADD_FAILURE() << "no error";
    return {{{.what = "none"}}, {}};
}

TEST(Pulses, ThatAreLateAfterTheLineWasSetAreErrors) {
    for (const auto &[opening, closing, what] :
         {std::tuple{31ms, 0ms, "pulse 1 of 1 opened 31.0"},
          std::tuple{0ms, 2000ms, "pulse 1 of 1 closed 2000.0"}}) {
        VirtualClock clock;
        SlowLine shutter(clock, opening, closing);
        const PulsesFailed error =
            failure_of({.width = 20ms, .period = 5s, .count = 1}, shutter, clock);
        EXPECT_TRUE(error.problems()[0].what.starts_with(what)) << error.what();
        EXPECT_EQ(error.problems()[0].where, "shutter");
        EXPECT_TRUE(error.report().pulses.empty());
        EXPECT_FALSE(shutter.active());
    }
}

TEST(Pulses, MayBeLateByTheToleranceButNotMore) {
    EXPECT_EQ(default_tolerance(20ms), 500us);
    EXPECT_EQ(default_tolerance(25ms), 500us);
    EXPECT_EQ(default_tolerance(1s), 20ms);
    struct Case {
        std::chrono::nanoseconds width;
        std::optional<std::chrono::nanoseconds> tolerance;
        std::chrono::nanoseconds allowed;
    };
    for (const Case &c : {Case{20ms, {}, 500us}, Case{1s, {}, 20ms}, Case{20ms, 3ms, 3ms}}) {
        const PulseTrain train{
            .width = c.width, .period = 5s, .count = 2, .tolerance = c.tolerance};
        VirtualClock clock;
        SlowLine just(clock, c.allowed, 0ns);
        EXPECT_EQ(run_pulses(train, {.shutter = just, .clock = clock}).largest_late, c.allowed);
        SlowLine slower(clock, c.allowed + 1ns, 0ns);
        failure_of(train, slower, clock);
        SlowLine closes(clock, 0ns, c.allowed + 1ns);
        failure_of(train, closes, clock);
    }
}

TEST(Pulses, AnErrorCarriesThePulsesThatWereDone) {
    SimulatedRig simulated;
    simulated.clock.at(10210ms, [&] { simulated.clock.advance(30ms); }); // the third closes late
    const PulsesFailed error = failure_of(three_pulses(), simulated.shutter, simulated.clock);
    ASSERT_EQ(error.report().pulses.size(), 2u);
    EXPECT_EQ(error.report().pulses[1].closed, 120ms);
    EXPECT_EQ(error.report().mean_width, 20ms);
    EXPECT_EQ(error.report().largest_late, 0ns);
}

TEST(Pulses, AnInterruptionCarriesThePulsesThatWereDone) {
    SimulatedRig simulated;
    std::atomic<bool> stop{false};
    simulated.clock.at(10110ms, [&] { stop = true; });
    try {
        run_pulses(three_pulses(), simulated.rig, {.stop = &stop});
        FAIL() << "not interrupted";
    } catch (const PulsesInterrupted &interrupted) {
        ASSERT_EQ(interrupted.report().pulses.size(), 1u);
        EXPECT_EQ(interrupted.report().pulses[0].closed, 20ms);
        EXPECT_TRUE(std::string(interrupted.what()).starts_with("stopped after 1 of 3"));
    }
    simulated.expect_off();
}

TEST(PulseTrain, NamesEverythingThatIsOutOfRange) {
    try {
        check_pulse_train({.width = 0ms, .period = 0ms, .count = 0, .warm_up = -1ms}, "train");
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 4u);
        EXPECT_EQ(error.problems()[0].where, "train.width");
        EXPECT_EQ(error.problems()[1].where, "train.period");
        EXPECT_EQ(error.problems()[2].where, "train.count");
        EXPECT_EQ(error.problems()[3].where, "train.warm_up");
        EXPECT_EQ(error.problems()[2].accepted, "expected 1 to 1000000");
    }
}

TEST(PulseTrain, IsCheckedBeforeAnythingMoves) {
    const std::vector<PulseTrain> bad{{.width = -1ns},
                                      {.width = 20ms, .period = 20ms},
                                      {.width = 20ms, .period = 1h + 1ns},
                                      {.count = -1},
                                      {.count = 1'000'001},
                                      {.warm_up = 24h + 1ns}};
    for (const PulseTrain &train : bad) {
        SimulatedRig simulated;
        EXPECT_THROW(run_pulses(train, simulated.rig), Error);
        EXPECT_TRUE(simulated.lamp.transitions().empty());
    }
    EXPECT_THROW(check_pulse_train({.tolerance = 0ns}), Error);
    EXPECT_NO_THROW(check_pulse_train({.width = 20ms, .period = 20ms + 1ns}));
}

TEST(PulseJob, RunsInVirtualTimeWithoutHardware) {
    const PulseJob job{.train = {.width = 20ms, .period = 100ms, .count = 5, .warm_up = 15min},
                       .lamp = GpioLineSettings{.line = "lamp"},
                       .simulate = true};
    const PulseReport report = run_pulse_job(job);
    EXPECT_EQ(report.pulses.size(), 5u);
    EXPECT_EQ(report.largest_late, 0ns);
}

TEST(PulseJob, RefusesOneLineForBoth) {
    const PulseJob job{
        .shutter = {.line = "lamp"}, .lamp = GpioLineSettings{.line = "lamp"}, .simulate = true};
    EXPECT_THROW(run_pulse_job(job), Error);
}

TEST(PulseJob, RefusesEmptyNames) {
    try {
        run_pulse_job({.shutter = {.line = ""}, .lamp = GpioLineSettings{}, .simulate = true});
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_GE(error.problems().size(), 2u);
        EXPECT_EQ(error.problems()[0].where, "shutter");
        EXPECT_EQ(error.problems()[1].where, "lamp");
    }
}

TEST(PulseJob, ChecksTheTrainBeforeItTakesALine) {
    try {
        run_pulse_job({.train = {.count = 0}});
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "count");
    }
}

} // namespace
} // namespace tsuya::lab

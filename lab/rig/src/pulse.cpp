#include "tsuya/lab/pulse.h"

#include "pulse_report.h"
#include "tsuya/lab/off_guard.h"
#include "tsuya/sdk/detail/counted.h"

#include <algorithm>
#include <exception>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

std::string in_ms(nanoseconds duration) {
    return std::to_string(std::chrono::duration<double, std::milli>(duration).count()) + " ms";
}

[[noreturn]] void throw_interrupted(const PulseReport &done, const PulseTrain &train) {
    throw Interrupted(stopped_after(done, train));
}

/// A train under way.
struct Run {
    const PulseTrain &train;
    const Rig &rig;
    const Progress &progress;
    nanoseconds tolerance;
    nanoseconds start; ///< planned opening of the first pulse
    PulseReport &report;

    void refuse_late(int index, const char *moved, nanoseconds late) const {
        if (late > tolerance)
            throw Error({.what = "pulse " + std::to_string(index + 1) + " of " +
                                 std::to_string(train.count) + ' ' + moved + ' ' + in_ms(late) +
                                 " late",
                         .where = rig.shutter.name(),
                         .accepted = "at most " + in_ms(tolerance) +
                                     ": a computer with less other work, or a larger tolerance"});
    }
};

void open_and_close(const Run &run, int index) {
    const nanoseconds open_at = run.start + index * run.train.period;
    const nanoseconds close_at = open_at + run.train.width;
    Clock &clock = run.rig.clock;
    if (!clock.sleep_until(open_at, run.progress.stop))
        throw_interrupted(run.report, run.train);
    run.refuse_late(index, "would have opened", clock.now() - open_at);
    PulseTiming timing;
    run.rig.shutter.set(true);
    timing.opened = clock.now() - run.start;
    run.refuse_late(index, "opened", timing.opened - (open_at - run.start));
    const bool whole = clock.sleep_until(close_at, run.progress.stop);
    run.rig.shutter.set(false);
    timing.closed = clock.now() - run.start;
    if (!whole)
        throw_interrupted(run.report, run.train);
    run.refuse_late(index, "closed", timing.closed - (close_at - run.start));
    run.report.pulses.push_back(timing);
    if (run.rig.on_pulse)
        run.rig.on_pulse(timing);
}

void lit_pulses(const PulseTrain &train, const Rig &rig, const Progress &progress,
                PulseReport &report) {
    if (progress.stopped())
        throw_interrupted(report, train);
    if (rig.lamp)
        rig.lamp->set(true);
    progress("warm-up", 0.0);
    const Run run{.train = train,
                  .rig = rig,
                  .progress = progress,
                  .tolerance = train.tolerance.value_or(default_tolerance(train.width)),
                  .start = rig.clock.now() + train.warm_up,
                  .report = report};
    for (int i = 0; i < train.count; ++i) {
        open_and_close(run, i);
        progress("pulses", static_cast<double>(i + 1) / train.count);
    }
}

/// The exception as problems, so that others can be said beside it.
std::vector<Problem> problems_of(const std::exception_ptr &cause) {
    try {
        std::rethrow_exception(cause);
    } catch (const Error &error) {
        return error.problems();
    } catch (const std::exception &error) {
        return {{.what = error.what()}};
    } catch (...) {
        return {{.what = "unknown error"}};
    }
}

/// Throws the cause with the pulses that were done.
[[noreturn]] void throw_with(const PulseReport &report, const std::exception_ptr &cause) {
    try {
        std::rethrow_exception(cause);
    } catch (const Error &error) {
        throw PulsesFailed(error.problems(), report);
    } catch (const Interrupted &interrupted) {
        throw PulsesInterrupted(interrupted.what(), report);
    }
}

} // namespace

void summarize(const PulseTrain &train, PulseReport &report) {
    if (report.pulses.empty())
        return;
    nanoseconds width{0};
    nanoseconds late{0};
    for (std::size_t i = 0; i < report.pulses.size(); ++i) {
        const nanoseconds plan = static_cast<std::int64_t>(i) * train.period;
        const nanoseconds late_open = report.pulses[i].opened - plan;
        const nanoseconds late_close = report.pulses[i].closed - plan - train.width;
        width += report.pulses[i].closed - report.pulses[i].opened;
        late += late_open + late_close;
        report.largest_late = std::max({report.largest_late, late_open, late_close});
    }
    const auto count = static_cast<std::int64_t>(report.pulses.size());
    report.mean_width = width / count;
    report.mean_late = late / (2 * count);
}

std::string stopped_after(const PulseReport &done, const PulseTrain &train) {
    return "stopped after " + std::to_string(done.pulses.size()) + " of " +
           detail::counted(static_cast<std::size_t>(train.count), "pulse") +
           "; the lamp is off and the shutter closed";
}

nanoseconds default_tolerance(nanoseconds width) {
    constexpr nanoseconds kLeast = std::chrono::microseconds(500);
    constexpr int kShare = 50; // 2 %
    return std::max(kLeast, width / kShare);
}

void check_pulse_train(const PulseTrain &train, const std::string &where) {
    Problems problems;
    const std::string prefix = where.empty() ? "" : where + ".";
    const auto require = [&](bool good, const char *field, const std::string &value,
                             const std::string &accepted) {
        problems.need(good, "it is " + value, prefix + field, "expected " + accepted);
    };
    require(train.width > nanoseconds(0), "width", in_ms(train.width), "more than 0 ms");
    require(train.period > train.width && train.period <= kLongestPeriod, "period",
            in_ms(train.period), "more than the width of " + in_ms(train.width) + ", at most 1 h");
    require(train.count >= 1 && train.count <= kMostPulses, "count", std::to_string(train.count),
            "1 to " + std::to_string(kMostPulses));
    require(train.warm_up >= nanoseconds(0) && train.warm_up <= kLongestWarmUp, "warm_up",
            in_ms(train.warm_up), "0 to 24 h");
    if (train.tolerance)
        require(*train.tolerance > nanoseconds(0), "tolerance", in_ms(*train.tolerance),
                "more than 0 ms");
    problems.throw_if_any();
}

PulseReport run_pulses(const PulseTrain &train, const Rig &rig, const Progress &progress) {
    OffGuard guard({rig.lamp, &rig.shutter});
    check_pulse_train(train);
    PulseReport report;
    std::exception_ptr cause;
    try {
        lit_pulses(train, rig, progress, report);
    } catch (...) {
        cause = std::current_exception();
    }
    const std::vector<Problem> still_on = guard.drive_off();
    summarize(train, report);
    if (!still_on.empty()) {
        std::vector<Problem> problems;
        if (cause)
            problems = problems_of(cause);
        problems.insert(problems.end(), still_on.begin(), still_on.end());
        throw PulsesFailed(std::move(problems), report);
    }
    if (cause)
        throw_with(report, cause);
    return report;
}

} // namespace tsuya::lab

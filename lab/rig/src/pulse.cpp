#include "tsuya/lab/pulse.h"

#include "tsuya/lab/off_guard.h"

#include <algorithm>
#include <exception>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

constexpr int kMaxCount = 1'000'000;
constexpr nanoseconds kMaxPeriod = std::chrono::hours(1);
constexpr nanoseconds kMaxWarmUp = std::chrono::hours(24);

std::string in_ms(nanoseconds duration) {
    return std::to_string(std::chrono::duration<double, std::milli>(duration).count()) + " ms";
}

[[noreturn]] void throw_interrupted(int done, int count) {
    throw Interrupted("stopped after " + std::to_string(done) + " of " + std::to_string(count) +
                      " pulses; the lamp is off and the shutter closed");
}

void open_and_close(const PulseTrain &train, const Rig &rig, const Progress &progress, int index,
                    nanoseconds start, PulseReport &report) {
    const nanoseconds open_at = start + index * train.period;
    const nanoseconds close_at = open_at + train.width;
    if (!rig.clock.sleep_until(open_at, progress.stop))
        throw_interrupted(index, train.count);
    if (const nanoseconds late = rig.clock.now() - open_at; late >= train.width)
        throw Error({.what = "pulse " + std::to_string(index + 1) + " of " +
                             std::to_string(train.count) + " came " + in_ms(late) +
                             " late, after it should have ended",
                     .where = rig.shutter.name(),
                     .accepted = "a longer width or a computer with less other work"});
    PulseTiming timing;
    rig.shutter.set(true);
    timing.opened = rig.clock.now() - start;
    const bool whole = rig.clock.sleep_until(close_at, progress.stop);
    rig.shutter.set(false);
    timing.closed = rig.clock.now() - start;
    if (!whole)
        throw_interrupted(index, train.count);
    report.pulses.push_back(timing);
}

void summarize(const PulseTrain &train, PulseReport &report) {
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

PulseReport lit_pulses(const PulseTrain &train, const Rig &rig, const Progress &progress) {
    PulseReport report;
    if (progress.stopped())
        throw_interrupted(0, train.count);
    if (rig.lamp)
        rig.lamp->set(true);
    progress("warm-up", 0.0);
    const nanoseconds start = rig.clock.now() + train.warm_up;
    for (int i = 0; i < train.count; ++i) {
        open_and_close(train, rig, progress, i, start, report);
        progress("pulses", static_cast<double>(i + 1) / train.count);
    }
    summarize(train, report);
    return report;
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

} // namespace

void check_pulse_train(const PulseTrain &train, const std::string &where) {
    Problems problems;
    const std::string prefix = where.empty() ? "" : where + ".";
    const auto require = [&](bool good, const char *field, const std::string &value,
                             const std::string &accepted) {
        problems.need(good, "is " + value, prefix + field, accepted);
    };
    require(train.width > nanoseconds(0), "width", in_ms(train.width), "more than 0 ms");
    require(train.period > train.width && train.period <= kMaxPeriod, "period", in_ms(train.period),
            "more than the width of " + in_ms(train.width) + ", at most 1 h");
    require(train.count >= 1 && train.count <= kMaxCount, "count", std::to_string(train.count),
            "1 to " + std::to_string(kMaxCount));
    require(train.warm_up >= nanoseconds(0) && train.warm_up <= kMaxWarmUp, "warm_up",
            in_ms(train.warm_up), "0 to 24 h");
    problems.throw_if_any();
}

PulseReport run_pulses(const PulseTrain &train, const Rig &rig, const Progress &progress) {
    OffGuard guard({rig.lamp, &rig.shutter});
    check_pulse_train(train);
    PulseReport report;
    std::exception_ptr cause;
    try {
        report = lit_pulses(train, rig, progress);
    } catch (...) {
        cause = std::current_exception();
    }
    const std::vector<Problem> still_on = guard.drive_off();
    if (still_on.empty()) {
        if (cause)
            std::rethrow_exception(cause);
        return report;
    }
    std::vector<Problem> problems;
    if (cause)
        problems = problems_of(cause);
    problems.insert(problems.end(), still_on.begin(), still_on.end());
    throw Error(std::move(problems));
}

} // namespace tsuya::lab

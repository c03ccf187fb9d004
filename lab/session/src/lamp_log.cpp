#include "tsuya/lab/lamp_log.h"

#include "tsuya/sdk/file.h"

#include <algorithm>
#include <ctime>

namespace tsuya::lab {
namespace {

constexpr double kSecondsOfHour = 3600;

double seconds_of(clockid_t clock) {
    timespec time{};
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Seconds from one moment to another; below 0 where nobody can know.
double elapsed_s(const Moment &from, const Moment &to) {
    return from.boot == to.boot ? to.boottime_s - from.boottime_s : to.time_s - from.time_s;
}

} // namespace

Moment moment_now() {
    std::string boot = read_file("/proc/sys/kernel/random/boot_id");
    boot.erase(std::min(boot.find('\n'), boot.size()));
    return {.boot = std::move(boot),
            .boottime_s = seconds_of(CLOCK_BOOTTIME),
            .time_s = seconds_of(CLOCK_REALTIME)};
}

Seconds restrike_left(const LampState &state, Seconds restrike, const Moment &now) {
    if (!state.last || state.lit)
        return Seconds(0);
    const double off_s = elapsed_s(*state.last, now);
    if (off_s < 0)
        return restrike;
    return std::max(Seconds(0), restrike - Seconds(off_s));
}

LampLog::LampLog(const std::filesystem::path &file, std::string serial, Moments moments,
                 int strikes)
    : serial_(std::move(serial)), moments_(std::move(moments)), state_{.strikes = strikes} {
    if (file.empty())
        return;
    file_.emplace(file);
    for (const JournalEvent &event : file_->before().events)
        take(event);
    state_.strikes = std::max(state_.strikes, strikes);
    if (state_.lit) {
        state_.last = moments_(); // how long it burned since then is not known
        note(false, "the program ended while the lamp was lit");
    }
}

void LampLog::take(const JournalEvent &event) {
    if (event.kind != EventKind::lamp || event.text("serial") != serial_)
        return;
    state_ = {.lit = event.number("on") != 0,
              .strikes = static_cast<int>(event.number("strike")),
              .hours = event.number("hours"),
              .last = Moment{.boot = event.text("boot"),
                             .boottime_s = event.number("boottime_s"),
                             .time_s = event.time_s}};
}

double LampLog::hours_now() const {
    if (!state_.lit)
        return state_.hours;
    return state_.hours + std::max(0.0, elapsed_s(*state_.last, moments_())) / kSecondsOfHour;
}

const LampState &LampLog::light() {
    ++state_.strikes;
    note(true);
    return state_;
}

const LampState &LampLog::put_out() {
    state_.hours = hours_now();
    note(false);
    return state_;
}

void LampLog::note(bool on, const std::string &what) {
    const Moment now = moments_();
    state_.lit = on;
    state_.last = now;
    if (!file_)
        return;
    JournalEvent event{.kind = EventKind::lamp,
                       .texts = {{"serial", serial_}, {"boot", now.boot}},
                       .numbers = {{"on", on ? 1.0 : 0.0},
                                   {"strike", state_.strikes},
                                   {"hours", state_.hours},
                                   {"boottime_s", now.boottime_s}},
                       .time_s = now.time_s};
    if (!what.empty())
        event.texts["what"] = what;
    file_->append(std::move(event));
    file_->sync();
}

} // namespace tsuya::lab

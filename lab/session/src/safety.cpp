#include "tsuya/lab/safety.h"

#include "tsuya/lab/journal.h"

#include <algorithm>

namespace tsuya::lab {

bool SafetyClock::sleep_until(std::chrono::nanoseconds deadline, const std::atomic<bool> *stop) {
    const Waiting waiting(clock_);
    for (;;) {
        check();
        const std::chrono::nanoseconds wake =
            interlock_ || estop_ ? std::min<std::chrono::nanoseconds>(deadline, now() + kLook)
                                 : deadline;
        if (!clock_.sleep_until(wake, stop))
            return false;
        if (wake == deadline)
            break;
    }
    check();
    return true;
}

bool SafetyClock::seen(InputLine &input, bool active) {
    try {
        bool was = false;
        while (const auto event = input.wait(Edge::any, clock_.now(), nullptr))
            was = was || event->active == active;
        return was || input.active() == active;
    } catch (const Error &error) {
        throw SessionFault(error.problems().front(), true);
    }
}

void SafetyClock::check() {
    if (interlock_ && seen(*interlock_, false))
        throw SessionFault({"the interlock is open", interlock_->name(), "close the housing"},
                           true);
    if (estop_ && seen(*estop_, true))
        throw SessionFault(
            {"the emergency stop is pressed", estop_->name(), "release it when all is safe"}, true);
}

std::optional<std::string> latched_fault(const std::filesystem::path &log) {
    if (!std::filesystem::exists(log))
        return std::nullopt;
    const Journal journal = read_journal(log);
    if (journal.events.empty() || journal.events.back().kind != EventKind::fault)
        return std::nullopt;
    return journal.events.back().text("why");
}

void latch_fault(const std::filesystem::path &log, const std::string &why, double time_s) {
    JournalWriter writer(log);
    writer.append({.kind = EventKind::fault, .texts = {{"why", why}}, .time_s = time_s});
    writer.sync();
}

void acknowledge_fault(const std::filesystem::path &log, const std::string &reason, double time_s) {
    if (reason.empty())
        throw Error({"the reason is empty", "reason", "expected what was found and done"});
    if (!latched_fault(log))
        throw Error({"there is no fault to be acknowledged", log.string(), ""});
    JournalWriter writer(log);
    writer.append({.kind = EventKind::note, .texts = {{"what", reason}}, .time_s = time_s});
    writer.sync();
}

std::filesystem::path fault_log_of(const std::filesystem::path &rig_file) {
    std::filesystem::path log = rig_file;
    return log.replace_extension(".faults.jsonl");
}

} // namespace tsuya::lab

#include "tsuya/lab/simulated_line.h"

#include <algorithm>

namespace tsuya::lab {
namespace {

bool is_set(const std::atomic<bool> *flag) { return flag && flag->load(); }

} // namespace

bool VirtualClock::pass(std::chrono::nanoseconds deadline, const std::atomic<bool> *stop) {
    while (!is_set(stop)) {
        const auto next = events_.begin();
        if (next == events_.end() || next->first > deadline) {
            now_ = std::max(now_, deadline);
            return true;
        }
        now_ = std::max(now_, next->first);
        const std::function<void()> event = std::move(next->second);
        events_.erase(next);
        event();
    }
    return false;
}

bool VirtualClock::sleep_until(std::chrono::nanoseconds deadline, const std::atomic<bool> *stop) {
    return pass(deadline, stop);
}

void VirtualClock::advance(std::chrono::nanoseconds duration) { pass(now_ + duration, nullptr); }

void VirtualClock::at(std::chrono::nanoseconds time, std::function<void()> event) {
    events_.emplace(time, std::move(event));
}

void SimulatedLine::set(bool to_active) {
    if (to_active != active())
        transitions_.push_back({clock_.now(), to_active});
}

} // namespace tsuya::lab

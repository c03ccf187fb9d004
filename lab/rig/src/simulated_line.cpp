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

void SimulatedInput::change(bool active) {
    if (active == active_)
        return;
    active_ = active;
    changes_.push_back({clock_.now(), active});
    changed_ = true;
}

std::optional<EdgeEvent> SimulatedInput::wait(Edge edge, std::chrono::nanoseconds deadline,
                                              const std::atomic<bool> *stop) {
    while (!is_set(stop)) {
        changed_ = false;
        for (; !changes_.empty(); changes_.pop_front()) {
            const EdgeEvent event = changes_.front();
            if (edge == Edge::any || event.active == (edge == Edge::to_active)) {
                changes_.pop_front();
                return event;
            }
        }
        if (clock_.now() >= deadline)
            break;
        // A change ends the sleep at once, the stop flag within the slice.
        const std::chrono::nanoseconds slice = clock_.now() + SteadyClock::kStopLatency;
        static_cast<void>(
            clock_.sleep_until(stop ? std::min(deadline, slice) : deadline, &changed_));
    }
    return std::nullopt;
}

} // namespace tsuya::lab

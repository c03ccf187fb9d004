#include "tsuya/lab/clock.h"

#include <algorithm>
#include <ctime>

namespace tsuya::lab {
namespace {

constexpr std::chrono::nanoseconds kSecond = std::chrono::seconds(1);

bool is_set(const std::atomic<bool> *flag) { return flag && flag->load(); }

} // namespace

std::chrono::nanoseconds SteadyClock::now() {
    timespec time{};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

// A signal that comes between the look at `stop` and the sleep would be slept through, and one that
// another thread handles does not wake this one: hence sleeps of at most kStopLatency.
bool SteadyClock::sleep_until(std::chrono::nanoseconds deadline, const std::atomic<bool> *stop) {
    for (auto time = now(); time < deadline; time = now()) {
        if (is_set(stop))
            return false;
        const std::chrono::nanoseconds wake =
            stop ? std::min(deadline, time + kStopLatency) : deadline;
        const timespec until{wake / kSecond, (wake % kSecond).count()};
        clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
    }
    return !is_set(stop);
}

} // namespace tsuya::lab

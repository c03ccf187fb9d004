#pragma once
/// \file
/// Progress of long work, and how it is stopped.

#include <atomic>
#include <functional>
#include <string_view>

namespace tsuya {

/// Given to long work. The work calls `report` from one thread at a time, and looks at `stop`
/// often.
struct Progress {
    /// fraction in [0, 1] of the stage that is named; may be empty
    std::function<void(std::string_view stage, double fraction)> report{};
    const std::atomic<bool> *stop = nullptr; ///< set to true to ask the work to stop

    /// The caller asked the work to stop.
    bool stopped() const { return stop && stop->load(std::memory_order_relaxed); }
    /// Calls `report` where there is one.
    void operator()(std::string_view stage, double fraction) const {
        if (report)
            report(stage, fraction);
    }
};

} // namespace tsuya

#pragma once
/// \file
/// How long a part of the work took.

#include <chrono>
#include <ctime>
#include <string>

namespace tsuya {

/// A part of the work, by the clock and by what all threads of the process spent meanwhile.
struct Phase {
    std::string name{};
    double seconds = 0;
    double cpu_seconds = 0;
};

/// Measures a phase from its construction on.
class PhaseClock {
  public:
    /// The phase until now.
    Phase end(std::string name) const {
        return {std::move(name),
                std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(),
                static_cast<double>(std::clock() - cpu_start_) / CLOCKS_PER_SEC};
    }

  private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::clock_t cpu_start_ = std::clock();
};

} // namespace tsuya

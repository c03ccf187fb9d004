#pragma once
/// \file
/// Trains of exact shutter pulses under a lit lamp.

#include "tsuya/lab/clock.h"
#include "tsuya/lab/line.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tsuya::lab {

/// When the shutter opens and closes. Pulse i opens at i * period after the lamp is warm, and
/// closes `width` later.
struct PulseTrain {
    std::chrono::nanoseconds width = std::chrono::milliseconds(20);   ///< > 0
    std::chrono::nanoseconds period = std::chrono::milliseconds(100); ///< > width, <= 1 h
    int count = 1;                                                    ///< 1..1000000
    std::chrono::nanoseconds warm_up{0}; ///< lamp on before the first pulse; 0..24 h
    /// How late an opening or a closing may be; > 0. Without a value: `default_tolerance(width)`.
    std::optional<std::chrono::nanoseconds> tolerance{};
};

/// The larger of 0.5 ms and 2 % of the width.
std::chrono::nanoseconds default_tolerance(std::chrono::nanoseconds width);

inline constexpr int kMostPulses = 1'000'000;                              ///< of a train
inline constexpr std::chrono::hours kLongestPeriod{1}, kLongestWarmUp{24}; ///< of a train

/// Throws Error listing everything that is out of range.
/// \param where put before the field's name, as in `where.width`; may be empty
void check_pulse_train(const PulseTrain &train, const std::string &where = "");

/// One pulse as it was: times after the planned opening of the first pulse. The line had been set
/// when the time was read.
struct PulseTiming {
    std::chrono::nanoseconds opened{0};
    std::chrono::nanoseconds closed{0};
};

/// What is moved, and by which time. Only the shutter and the clock are needed.
struct Rig {
    OutputLine &shutter;
    Clock &clock;
    OutputLine *lamp = nullptr;
    std::function<void(const PulseTiming &)> on_pulse{}; ///< called after each pulse
};

/// A whole train as it was.
struct PulseReport {
    std::vector<PulseTiming> pulses{};        ///< one for each that was done, in order
    std::chrono::nanoseconds mean_width{0};   ///< mean of closed - opened
    std::chrono::nanoseconds mean_late{0};    ///< mean over all openings and closings
    std::chrono::nanoseconds largest_late{0}; ///< of any opening or closing after its plan
};

/// An Error in the middle of a train.
class PulsesFailed : public Error {
  public:
    /// With the pulses that were done before.
    PulsesFailed(std::vector<Problem> problems, PulseReport report)
        : Error(std::move(problems)), report_(std::move(report)) {}
    /// The pulses that were done, each within the tolerance.
    const PulseReport &report() const noexcept { return report_; }

  private:
    PulseReport report_;
};

/// A train that was stopped.
class PulsesInterrupted : public Interrupted {
  public:
    /// With the pulses that were done before.
    PulsesInterrupted(const std::string &what, PulseReport report)
        : Interrupted(what), report_(std::move(report)) {}
    /// The pulses that were done, each within the tolerance.
    const PulseReport &report() const noexcept { return report_; }

  private:
    PulseReport report_;
};

/// Lamp on, warm-up, the pulses, lamp off. Lamp and shutter are inactive when this returns or
/// throws, whatever happened; if one cannot be driven off, the Error says so beside the first
/// cause. `progress` is called after each pulse, on the thread that times them: give one that can
/// block through a ProgressRelay.
///
/// Throws Error for a train out of range, PulsesFailed for a line that fails or a pulse that opened
/// or closed later than the tolerance (the computer slept, was too busy, or setting the line took
/// too long), and PulsesInterrupted when `progress.stop` was set, which ends a pulse or a warm-up
/// in the middle. What `progress.report` throws is passed on.
PulseReport run_pulses(const PulseTrain &train, const Rig &rig, const Progress &progress = {});

} // namespace tsuya::lab

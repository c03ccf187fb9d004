#pragma once
/// \file
/// Pulses from names of lines to report in one call: what `tsuya lab pulse` does.

#include "tsuya/lab/gpio_line.h"
#include "tsuya/lab/pulse.h"

#include <optional>

namespace tsuya::lab {

/// A train and the lines that it moves.
struct PulseJob {
    PulseTrain train{};
    GpioLineSettings shutter{.line = "shutter"};
    std::optional<GpioLineSettings> lamp{};
    /// Virtual time and simulated lines: takes no time and needs no hardware.
    bool simulate = false;
    int library_threads = 0; ///< as of Supervision
};

/// Throws Error for an empty name of a line, and for one line as both lamp and shutter.
void check_pulse_lines(const PulseJob &job);

/// Takes the lines and runs the train, supervised where the lines are real. A job takes at least
/// warm_up + (count - 1) * period + width. Throws what check_pulse_lines, GpioLine and
/// run_supervised_pulses throw.
PulseReport run_pulse_job(const PulseJob &job, const Progress &progress = {});

/// run_pulses() in real time in a process of its own: lamp and shutter are driven off also when
/// that process is stopped or killed. Throws what run_supervised throws; errors and interruptions
/// carry the pulses that were done, as those of run_pulses do. \param lamp may be null
PulseReport run_supervised_pulses(const PulseTrain &train, OutputLine &shutter, OutputLine *lamp,
                                  const Progress &progress = {}, int library_threads = 0);

} // namespace tsuya::lab

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
};

/// Takes the lines and runs the train. A job takes at least warm_up + (count - 1) * period + width.
/// Throws what GpioLine and run_pulses throw; an empty name of a line, or one line for both lamp
/// and shutter, is an Error.
PulseReport run_pulse_job(const PulseJob &job, const Progress &progress = {});

} // namespace tsuya::lab

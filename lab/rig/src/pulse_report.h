#pragma once
/// \file
/// What is said of the pulses that were done.

#include "tsuya/lab/pulse.h"

namespace tsuya::lab {

/// Fills in the figures of the pulses in the report.
void summarize(const PulseTrain &train, PulseReport &report);

/// What an Interrupted says.
std::string stopped_after(const PulseReport &done, const PulseTrain &train);

} // namespace tsuya::lab

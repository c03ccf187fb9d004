#pragma once
/// \file
/// Phases of daylight.

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Daylight of a correlated colour temperature from 4000 to 25 000 K, at 5 nm from 360 to 830 nm.
/// [CIE015] section 4.1.3
Spectrum daylight(double kelvin);

} // namespace tsuya

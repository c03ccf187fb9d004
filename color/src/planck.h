#pragma once
/// \file
/// Planck's formula, relative to 100 at 560 nm.

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// \param c2_over_kelvin_nm the second radiation constant, in nm K, over the temperature
double planck(double nm, double c2_over_kelvin_nm);

/// The same at 1 nm from 360 to 830 nm.
Spectrum planck_spectrum(double c2_over_kelvin_nm);

} // namespace tsuya

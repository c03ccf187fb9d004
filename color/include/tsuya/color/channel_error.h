#pragma once
/// \file
/// How well a number of channels shows a reflectance.

#include "tsuya/sdk/spectral_basis.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// CIEDE2000 between a reflectance in channels and at 1 nm for the 2-degree observer: the largest
/// under D65, A and FL11, of one meeting with it and of two. \param reflectance 0..1
double channel_error(const Spectrum &reflectance, const SpectralBasis &basis);

} // namespace tsuya

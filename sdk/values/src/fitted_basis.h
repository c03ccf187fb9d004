#pragma once
// The basis of renders: where its channels are, what each sees of a spectrum, and what spectrum
// follows from them.

#include <memory>
#include <vector>

#include "tsuya/sdk/spectral_basis.h"

namespace tsuya {

// The weights of the channels of a fitted basis are given at these wavelengths, every nm.
inline constexpr int kFittedFirstNm = 360, kFittedLastNm = 830;

// Wavelengths of so many channels, two or more.
std::vector<double> fitted_nodes(int count);

// The weights of a fitted basis, [nm][channel]; made once for each set of nodes.
std::shared_ptr<const std::vector<double>> fitted_weights(const SpectralBasis &basis);

// The mean of a spectrum over the window of a channel.
double window_mean(const Spectrum &spectrum, const SpectralBasis &basis, int channel);

} // namespace tsuya

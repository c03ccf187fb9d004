#pragma once
// The filter for pictures that are looked at.

#include <optional>

#include "film.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

// Replaces each pixel of a film's picture by a weighted mean of the pixels around it, with the same
// weights for all groups and channels. The weights of the samples of even index come from those of
// odd index and the other way round, so that they do not depend on the noise that they average. A
// speck in one half, which neither the other half nor the pixels around have, is lowered to what is
// likely there.
// Differs from [Rousselle2012]: one pass, and features weigh, too.
// \return the share by which the mean of the picture changed; empty where progress.stop became
// true: the image is only partly filtered then
std::optional<double> denoise(const Film &film, const Camera &camera, SpectralImage &image,
                              const Progress &progress);

} // namespace tsuya

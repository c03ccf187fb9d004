#pragma once
/// \file
/// AOVs as pictures to look at.

#include <cstddef>

#include "tsuya/scene/picture.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya::scene {

/// Display-encoded R, G, B of an AOV, by what its channels are: transport and reflectance as they
/// look under `lamp`; directions with -1 as 0 and 1 as 1; places on the cloth as tiles of a
/// decimetre, in which u is red and v green; ids as colours; depth from white, the nearest, to
/// black, the farthest of 98 % of the pixels; of all others the largest of 98 % is white.
/// \param aov its number in the image. Throws Error for one that the image has not, and as
/// picture_under.
Image aov_picture(const SpectralImage &transport, std::size_t aov, const NamedLamp &lamp,
                  const DisplayOptions &look = default_look());

} // namespace tsuya::scene

#pragma once
/// \file
/// From lamp-free light transport to the picture of a display in one pass.

#include "tsuya/color/config.h"
#include "tsuya/color/relight.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// Display-encoded R, G, B in [0, 1] under a lighting, as `display` makes it of `relight` from the
/// adopted_white; where the transport has alpha also A, by which the colours are not multiplied (as
/// PNG has it). On the display sRGB the matrices of lamps, adaptation and display are one, and
/// nothing stands between the channels and the codes. A pixel that is not finite becomes NaN.
/// Throws Error as relight and display.
Image shown_picture(const SpectralImage &transport, const Lighting &lighting,
                    const DisplayOptions &options = {});

/// Linear light with the primaries of Rec. 709, R, G, B and where the transport has alpha A, by
/// which the colours are multiplied (as EXR has it): before the view, adapted and exposed as the
/// options say; neither limited nor curved. Throws Error as relight, and as adaptation_matrix.
Image linear_picture(const SpectralImage &transport, const Lighting &lighting,
                     const DisplayOptions &options = {});

/// The share of pixels whose colour lies outside of the triangle of the sRGB primaries, which a
/// display has to replace: of those of the garment, see garment_pixels. 0 where there are none.
double share_out_of_gamut(const SpectralImage &transport, const Lighting &lighting,
                          const DisplayOptions &options = {});

} // namespace tsuya

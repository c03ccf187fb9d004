#pragma once
/// \file
/// Where in a picture colours change between lamps.

#include "tsuya/color/compare.h"
#include "tsuya/color/relight.h"
#include "tsuya/color/sheet.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// CIEDE2000 of each pixel between two lightings, each adapted from its adopted_white: one channel,
/// NaN where the pixel does not count (see garment_pixels) or is not finite. Throws Error as
/// compare_lightings.
Image difference_map(const SpectralImage &transport, const Lighting &first, const Lighting &second,
                     const CompareOptions &options = {});

/// The difference that is drawn brightest, as are larger ones.
inline constexpr double kBrightestDifference = 10;

/// A map as a picture R, G, B: from dark blue for 0 over red to light yellow; grey where it is NaN.
Image picture_of_differences(const Image &map);

/// The colours of such a picture with their differences beside them, of a size.
SheetPicture difference_legend(int width, int height);

} // namespace tsuya

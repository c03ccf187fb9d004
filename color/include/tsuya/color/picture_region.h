#pragma once
/// \file
/// Parts of a picture that reports speak of: the garment, and what ids of Cryptomatte tell apart.

#include <cstddef>
#include <string>
#include <vector>

#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// How much of each pixel the garment covers: the AOV `garment`, else `coverage`, else alpha; null
/// where the picture has none of them.
const Image *garment_coverage(const SpectralImage &transport);

/// For each pixel, row by row, whether it counts as the garment: where it covers at least half of
/// it, see garment_coverage; where nothing tells, where the transport is not all 0.
std::vector<char> garment_pixels(const SpectralImage &transport);

/// A part of a picture.
struct PictureRegion {
    std::string kind{};                ///< `garment`, `fabric`, `panel` or `object`
    std::string name{};                ///< of the scene; empty for the garment
    std::vector<std::size_t> pixels{}; ///< x + width * y, rising; never empty
};

/// The garment, and where the picture has the AOVs CryptoFabric, CryptoPanel and CryptoObject each
/// of their names that covers a pixel. A part has the pixels that it fills, but for 2 %, and where
/// there are none those that it covers by half. Pixels that are not finite in the transport are
/// left out. Throws Error at the AOV's name for ids without a readable manifest.
std::vector<PictureRegion> picture_regions(const SpectralImage &transport);

} // namespace tsuya

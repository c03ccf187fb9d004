#pragma once
/// \file
/// Whether a picture says where it covers, without decoding it.

#include <string_view>

namespace tsuya::garment {

enum class PictureAlpha {
    has,
    has_not, ///< covers all
    unknown  ///< neither PNG nor JPEG
};

/// By the first bytes of a file: of a PNG its colour type and a chunk tRNS, of a JPEG nothing.
PictureAlpha alpha_in(std::string_view bytes);

} // namespace tsuya::garment

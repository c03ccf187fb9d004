#pragma once
/// \file
/// The rules of a picture of light transport that is written to a file.

#include <string>

#include "tsuya/sdk/spectral_image.h"

namespace tsuya {

/// Throws Error at `where` unless sizes agree and names can stand in a file.
void check_spectral_image(const SpectralImage &image, const std::string &where);

} // namespace tsuya

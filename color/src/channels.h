#pragma once
/// \file
/// Channels of an Image by name.

#include <array>
#include <cstddef>
#include <string>

#include "tsuya/sdk/image.h"

namespace tsuya {

/// Where the three named channels stand in the picture. Throws Error at `where` if one is missing,
/// or the data does not fit the size.
std::array<std::size_t, 3> channel_indices(const Image &image,
                                           const std::array<const char *, 3> &names,
                                           const std::string &where);

/// Throws Error at `where` unless the picture has pixels, channels, and as many values as those
/// say.
void check_image(const Image &image, const std::string &where);

} // namespace tsuya

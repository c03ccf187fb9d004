#pragma once
/// \file
/// CIELAB of the pixels of a picture.

#include <vector>

#include <glm/vec3.hpp>

#include "tsuya/color/compare.h"

namespace tsuya {

/// CIELAB of each pixel, adapted to sRGB's white, alpha taken out; also takes the pixels that are
/// not finite out of those that count.
std::vector<glm::vec3> lab_picture(const SpectralImage &transport, const Lighting &lighting,
                                   const CompareOptions &options, std::vector<char> &counts);

} // namespace tsuya

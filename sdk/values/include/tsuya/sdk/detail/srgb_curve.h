#pragma once
/// \file
/// The transfer curve of sRGB. [IEC61966]

#include <cmath>

namespace tsuya::detail {

/// Linear light to code value; negative numbers are mirrored.
inline double srgb_code(double linear) {
    const double size = std::abs(linear);
    const double code = size <= 0.0031308 ? 12.92 * size : 1.055 * std::pow(size, 1 / 2.4) - 0.055;
    return std::copysign(code, linear);
}

/// The inverse of srgb_code.
inline double srgb_light(double code) {
    const double size = std::abs(code);
    const double light = size <= 0.04045 ? size / 12.92 : std::pow((size + 0.055) / 1.055, 2.4);
    return std::copysign(light, code);
}

} // namespace tsuya::detail

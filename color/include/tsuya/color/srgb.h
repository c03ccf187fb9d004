#pragma once
/// \file
/// The display space: primaries and white of Rec. 709, transfer curve of sRGB. [IEC61966]

#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tsuya {

/// XYZ of sRGB's white, chromaticity 0.3127, 0.3290, with Y = 1.
glm::dvec3 srgb_white();

/// XYZ (white of srgb_white) to linear Rec. 709 RGB, from the primaries, in double.
glm::dmat3 srgb_from_xyz();
/// The inverse of srgb_from_xyz.
glm::dmat3 xyz_from_srgb();

/// Linear light to code value, and back. Both take any number; negative ones are mirrored.
double srgb_encode(double linear);
/// The inverse of srgb_encode.
double srgb_decode(double encoded);

/// Linear RGB of `#rrggbb` or `#rgb`. Throws Error at `where` for another text.
glm::dvec3 parse_srgb(std::string_view text, std::string_view where = "colour");

} // namespace tsuya

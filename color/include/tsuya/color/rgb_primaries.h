#pragma once
/// \file
/// Primaries of displays and of linear light.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace tsuya {

/// Chromaticities of red, green, blue and white.
struct RgbPrimaries {
    glm::dvec2 red{0, 0}, green{0, 0}, blue{0, 0}, white{0, 0};
};

/// Those of Rec. 709 and sRGB. [IEC61966] Table 1
inline constexpr RgbPrimaries kRec709{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};
/// Those of Rec. 2020 and Rec. 2100. [BT2100] Table 2
inline constexpr RgbPrimaries kRec2020{
    {0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}};
/// Those of Display P3. [P3D65]
inline constexpr RgbPrimaries kDisplayP3{
    {0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}};

/// Linear RGB to XYZ, in which (1, 1, 1) becomes the white with Y = 1.
glm::dmat3 xyz_from_rgb(const RgbPrimaries &primaries);

} // namespace tsuya

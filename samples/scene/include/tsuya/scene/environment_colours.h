#pragma once
/// \file
/// Coloured environments that stay relightable: a picture in R, G and B as three pictures, each the
/// light of one smooth lamp.

#include <array>

#include "tsuya/sdk/image.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya::scene {

inline constexpr std::size_t kEnvironmentLamps = 3;
/// What they are called in files and reports.
inline constexpr std::array<const char *, kEnvironmentLamps> kEnvironmentLampNames{
    "environment-red", "environment-green", "environment-blue"};

/// The lamps: D65 cut into its red, green and blue third, smoothly. Their sum is D65, so that a
/// grey environment is daylight.
std::array<Spectrum, kEnvironmentLamps> environment_lamps();

/// A picture as a mixture of these lamps.
struct EnvironmentColours {
    Image picture{}; ///< one channel for each lamp; their sum is the luminance
    /// Root of the sum of squared differences of X, Y and Z from the picture's over that of X, Y
    /// and Z, each pixel by the solid angle that it fills: of colours more saturated than the
    /// lamps are, and of values below 0.
    double error = 0;
};

/// The mixture of each pixel by least squares of X, Y, Z, no lamp below 0. \param rgb
/// latitude-longitude; its channels R, G and B, linear Rec. 709. Throws Error at `picture` where it
/// has none of these.
EnvironmentColours environment_colours(const Image &rgb);

} // namespace tsuya::scene

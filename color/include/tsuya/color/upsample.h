#pragma once
/// \file
/// A reflectance for a colour.

#include <string>

#include <glm/vec3.hpp>

#include "tsuya/color/observer.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// A smooth reflectance, every 10 nm from 380 to 730 nm and inside [0, 1], that has the colour
/// `linear_rgb` (Rec. 709, each 0..1) under D65 for the 2-degree observer; a grey is constant. Of
/// all such it is the one with the least squared slope of artanh(2 R - 1) [Burns]. Throws Error at
/// `where` for a part outside [0, 1] and for a colour that no such reflectance has.
Spectrum reflectance_of_srgb(const glm::dvec3 &linear_rgb, const std::string &where = "colour");

/// The same for a CIELAB colour under a lamp, for an observer, of which a perfect white has L* =
/// 100. Colours outside sRGB are no matter. Throws Error at `where` for L* outside [0, 100], a
/// lamp without visible power and a colour that no such reflectance has.
Spectrum reflectance_of_lab(const glm::dvec3 &lab, const Spectrum &lamp, Observer observer,
                            const std::string &where = "colour");

} // namespace tsuya

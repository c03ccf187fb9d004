#pragma once
/// \file
/// CIE standard observers: from spectra to tristimulus values XYZ.

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Which eye looks: the 2-degree field of 1931, or the 10-degree field of 1964.
enum class Observer { cie1931, cie1964 };

/// All integrals run over these wavelengths. [CIE015]
inline constexpr int kObserverFirstNm = 360;
inline constexpr int kObserverLastNm = 830;

/// The colour matching functions x, y, z at a whole wavelength in nm; 0 outside 360-830.
glm::dvec3 color_matching(Observer observer, int wavelength_nm);

/// A term of an integral over wavelength under a lamp.
struct ColorWeight {
    double wavelength_nm = 0;
    glm::dvec3 xyz{0, 0, 0}; ///< what a perfect white adds here; all terms together have Y = 1
};

/// The terms of lamp x observer by the trapezoidal rule on the union of the whole nanometres from
/// 360 to 830, the lamp's samples, and `more_nm`: a line of a tenth of a nanometre counts in full,
/// and where all samples are whole nanometres it is the sum at 1 nm of [CIE015] section 7.1. The
/// observer is linear between whole nanometres. Terms are in order of wavelength. Throws Error if
/// the lamp has no visible power.
std::vector<ColorWeight> color_weights(const Spectrum &lamp, Observer observer = Observer::cie1931,
                                       std::span<const double> more_nm = {});

/// The sum of lamp x y over the same terms: luminous power in the lamp's unit, times 1 nm. 0 or
/// more for lamps that are nowhere negative.
double luminous_power(const Spectrum &lamp, Observer observer = Observer::cie1931);

/// XYZ of a surface of reflectance `reflectance` under `lamp`, summed over `color_weights` with the
/// samples of the reflectance; a perfect white (reflectance 1) has Y = 1. The lamp's unit does not
/// matter. Throws Error if the lamp has no visible power. [CIE015] section 7.1
glm::dvec3 xyz_of(const Spectrum &lamp, const Spectrum &reflectance,
                  Observer observer = Observer::cie1931);

/// XYZ of a perfect white under `lamp`: Y = 1. Throws Error as xyz_of.
glm::dvec3 white_of(const Spectrum &lamp, Observer observer = Observer::cie1931);

/// Chromaticity x, y of tristimulus values; (0, 0) where X + Y + Z is 0.
glm::dvec2 chromaticity(const glm::dvec3 &xyz);

/// XYZ with Y = 1 of a chromaticity; `xy.y` must be greater than 0.
glm::dvec3 xyz_of_chromaticity(const glm::dvec2 &xy);

} // namespace tsuya

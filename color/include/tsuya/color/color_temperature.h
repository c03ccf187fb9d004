#pragma once
/// \file
/// How near a white is to that of a glowing black body, and of which temperature.

#include <optional>

#include <glm/vec2.hpp>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Correlated colour temperature. [CIE015] section 9.5
struct ColorTemperature {
    double kelvin = 0;
    /// Distance from the Planckian locus in the diagram u, v of 1960; above it (greenish) > 0.
    double duv = 0;
};

/// Of a chromaticity x, y for the 2-degree observer; nothing where it is farther than 0.05 from the
/// locus or nearest to 1000 K or less, 100 000 K or more.
std::optional<ColorTemperature> color_temperature(const glm::dvec2 &xy);

/// Relative power of a black body at 1 nm from 360 to 830 nm, 100 at 560 nm, by Planck's formula
/// with c2 = 0.014388 m K. \param kelvin greater than 0
Spectrum black_body(double kelvin);

} // namespace tsuya

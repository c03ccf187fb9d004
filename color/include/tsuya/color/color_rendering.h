#pragma once
/// \file
/// What lamps do to colours, in the figures of their data sheets.

#include <optional>

#include <glm/vec2.hpp>

#include "tsuya/color/color_temperature.h"
#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Figures of a lamp.
struct LampFigures {
    glm::dvec2 xy{0, 0}; ///< chromaticity, 2-degree observer
    std::optional<ColorTemperature> temperature{};
    /// General colour rendering index Ra. [CIE133] Nothing without a colour temperature, and so the
    /// others.
    std::optional<double> ra{};
    std::optional<double> rf{}; ///< fidelity index, 0..100. [CIE224] [TM30]
    std::optional<double> rg{}; ///< gamut index, 100 is that of the reference. [TM30]
};

/// The figures of a lamp. References are black bodies below 5000 K for Ra and below 4000 K for Rf
/// and Rg, daylight above 5000 K, and for Rf and Rg a mixture between. Sums run at 1 nm over
/// samples at 5 nm. Throws Error if the lamp has no visible power.
LampFigures lamp_figures(const Spectrum &lamp);

} // namespace tsuya

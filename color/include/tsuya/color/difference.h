#pragma once
/// \file
/// CIELAB and colour differences: CIE76, CIEDE2000, CMC(l:c).

#include <string>

#include <glm/vec3.hpp>

namespace tsuya {

/// L*, a*, b* of `xyz` beside the white `white_xyz` (same scale, all parts > 0). [CIE015] section 8
glm::dvec3 lab_of(const glm::dvec3 &xyz, const glm::dvec3 &white_xyz);

/// The inverse of lab_of.
glm::dvec3 xyz_of_lab(const glm::dvec3 &lab, const glm::dvec3 &white_xyz);

/// CIEDE2000 between two CIELAB colours, with k_L = k_C = k_H = 1. About 1 is just noticeable.
/// [Sharma]
double ciede2000(const glm::dvec3 &lab_a, const glm::dvec3 &lab_b);

/// The distance in CIELAB. [CIE015] section 8.2.1
double cie76(const glm::dvec3 &lab_a, const glm::dvec3 &lab_b);

/// CMC(l:c), of which textiles have tolerances: not symmetric, the weights are those of the
/// standard. [ISO105J03]
/// \param lightness, chroma l and c, > 0: 2:1 where a match is accepted or not, 1:1 where it is
/// seen
double cmc(const glm::dvec3 &standard_lab, const glm::dvec3 &sample_lab, double lightness = 2,
           double chroma = 1);

/// A formula by name; `cmc` is CMC(2:1).
enum class DifferenceFormula { cie76, ciede2000, cmc };

/// The difference of two CIELAB colours, the first being the standard, by a formula.
double color_difference(DifferenceFormula formula, const glm::dvec3 &standard_lab,
                        const glm::dvec3 &sample_lab);

/// What reports call it: `CIE76`, `CIEDE2000`, `CMC(2:1)`.
std::string to_string(DifferenceFormula formula);

} // namespace tsuya

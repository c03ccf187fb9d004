#pragma once
/// \file
/// CIELAB and the colour difference CIEDE2000.

#include <glm/vec3.hpp>

namespace tsuya {

/// L*, a*, b* of `xyz` beside the white `white_xyz` (same scale, all parts > 0). [CIE015] section 8
glm::dvec3 lab_of(const glm::dvec3 &xyz, const glm::dvec3 &white_xyz);

/// The inverse of lab_of.
glm::dvec3 xyz_of_lab(const glm::dvec3 &lab, const glm::dvec3 &white_xyz);

/// CIEDE2000 between two CIELAB colours, with k_L = k_C = k_H = 1. About 1 is just noticeable.
/// [Sharma]
double ciede2000(const glm::dvec3 &lab_a, const glm::dvec3 &lab_b);

} // namespace tsuya

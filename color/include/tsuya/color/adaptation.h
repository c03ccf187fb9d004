#pragma once
/// \file
/// Chromatic adaptation: what an eye that is used to one white sees, as seen under another.

#include <string>
#include <string_view>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace tsuya {

/// `none` shows the colours as a daylight-adapted camera would record them; the others let the eye
/// adapt fully to the lamp, in the cone space of Bradford or of CIECAM02.
enum class Adaptation { none, bradford, cat02 };

/// The names `none`, `bradford`, `cat02`.
std::vector<std::string> adaptation_names();
/// Throws Error for an unknown name, with the known ones and the nearest.
Adaptation parse_adaptation(std::string_view name);
/// The name that parse_adaptation reads.
std::string to_string(Adaptation adaptation);

/// The matrix (GLM: column-major) from XYZ to the cone signals that are scaled: of [Lam] for
/// `bradford`, of [CIE159] for `cat02`, the identity for `none`.
glm::dmat3 cone_matrix(Adaptation adaptation);

/// Whether the three cone signals of a white are positive, so that an eye can be used to it. Those
/// of single lines are not; `none` is always possible.
bool can_adapt(Adaptation adaptation, const glm::dvec3 &from_white);

/// The matrix (GLM: column-major) that takes XYZ under `from_white` to XYZ under `to_white`, in von
/// Kries' form: cones of both whites by the matrix of [Lam] or [CIE159], cone by cone scaled, back.
/// Maps `from_white` on `to_white`; the identity for `none`. Whites are XYZ with Y > 0. Throws
/// Error if not can_adapt, and for a degree outside 0..1.
/// \param degree of adaptation, D of [CIE159]: cones are scaled by D to / from + 1 - D
glm::dmat3 adaptation_matrix(Adaptation adaptation, const glm::dvec3 &from_white,
                             const glm::dvec3 &to_white, double degree = 1);

} // namespace tsuya

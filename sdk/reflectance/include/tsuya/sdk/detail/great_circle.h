#pragma once
/// \file
/// The great-circle form of [Takeda] Eqs. 7-15: how a view under oblique light is carried to the
/// view under light from straight above whose reflectance it takes.
///
/// Polar coordinates about the horizontal axis R = -L_xy/|L_xy|: V = (beta, psi). The map changes
/// beta to beta0 and keeps psi.

#include <glm/glm.hpp>

namespace tsuya {

/// The image of a view, with what the Jacobian needs.
struct GreatCircle {
    glm::vec3 basic{0, 0, 1}; ///< V0, unit, z >= 0
    float beta = 0;           ///< angle between R and V
    float beta0 = 0;          ///< angle between R and V0
    float sine_ratio = 1;     ///< sin beta0 / sin beta, with its limits at beta = 0 and pi
    float slope = 1;          ///< dbeta0/dbeta
};

/// V0 of a view under a light. Both unit with z >= 0; light from straight above gives the identity.
/// Jacobian dV0/dV = sine_ratio * slope.
GreatCircle to_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer);

/// The inverse: the view that V0 comes from, with the Jacobian at it.
struct ViewOfBasic {
    glm::vec3 to_viewer{0, 0, 1};
    float sine_ratio = 1;
    float slope = 1;
};
ViewOfBasic view_of_basic(const glm::vec3 &to_light, const glm::vec3 &basic);

} // namespace tsuya

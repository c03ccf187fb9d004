#pragma once
/// \file
/// The great-circle form of [Takeda] Eqs. 7-15: how a view under oblique light is carried to the
/// view under light from straight above whose reflectance it takes.
///
/// Polar coordinates about the horizontal axis R = -L_xy/|L_xy|: V = (beta, psi). The map changes
/// beta to beta0 and keeps psi.

#include <optional>

#include <glm/glm.hpp>

namespace tsuya {

/// The image of a view, with what the Jacobian needs.
struct GreatCircle {
    glm::vec3 basic{0, 0, 1}; ///< V0, unit, z >= 0
    float beta = 0;           ///< angle between R and V
    float beta0 = 0;          ///< angle between R and V0
    float sine = 1;           ///< sin beta
    float tilt = 0;           ///< theta_i
    float sine_ratio = 1;     ///< sin beta0 / sin beta, with its limits at beta = 0 and pi
    float slope = 1;          ///< dbeta0/dbeta
};

/// V0 of a view under a light. Both unit with z >= 0; light from straight above gives the identity.
/// Jacobian dV0/dV = sine_ratio * slope.
GreatCircle to_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer);

/// The inverse for a fixed light: the view that V0 comes from, with the Jacobian at it.
struct ViewOfBasic {
    glm::vec3 to_viewer{0, 0, 1};
    float sine_ratio = 1;
    float slope = 1;
};
ViewOfBasic view_of_basic(const glm::vec3 &to_light, const glm::vec3 &basic);

/// The inverse for a fixed view: the light under which the view takes its reflectance from V0.
/// Empty where that light would be at or below the horizon.
std::optional<glm::vec3> light_of_basic(const glm::vec3 &to_viewer, const glm::vec3 &basic);

/// dV0/dL for a fixed view, at the light that `circle` was made with.
float jacobian_of_light(const GreatCircle &circle, const glm::vec3 &to_light,
                        const glm::vec3 &to_viewer);

} // namespace tsuya

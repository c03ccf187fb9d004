#pragma once
/// \file
/// Pairs of directions that a goniometer is asked to measure, and the usual sets of them.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// A light and a view, radians. theta in [0, pi/2) from the cloth's normal, phi from the weft.
struct DirectionPair {
    double theta_i = 0, phi_i = 0;
    double theta_r = 0, phi_r = 0;

    /// Unit, z >= 0.
    glm::dvec3 to_light() const { return direction_of(theta_i, phi_i); }
    /// Unit, z >= 0.
    glm::dvec3 to_viewer() const { return direction_of(theta_r, phi_r); }
    bool operator==(const DirectionPair &) const = default;
};

/// What is measured, in any order. Pairs of the same light share its photons.
struct Directions {
    std::vector<DirectionPair> pairs{};
    Symmetry symmetry = Symmetry::none; ///< written into the table
    /// Pairs that the set also lists, each equal to one in `pairs`.
    std::size_t repeated = 0;
};

/// Light from straight above and one quadrant of views, both angles every `step_deg` below (theta)
/// and up to (phi) 90 degrees; straight up once. Throws Error unless step_deg is in (0, 90].
Directions normal_incidence_quadrant(double step_deg);
/// The same for cloth of any symmetry: a quadrant of views if it is orthotropic, a half of them
/// (phi below 180) with half_turn, else all.
Directions normal_incidence(double step_deg, Symmetry symmetry);

/// The set of [Takeda]: theta_i every 15 degrees below 90 on the planes phi_i = 0, 45, 90; theta_r
/// every 3 and phi_r every 5 degrees. What differs by nothing is there once (straight down and
/// straight up at every phi), which leaves 33,424 of 38,880. Coarser views by the steps in degrees.
Directions paper_directions(double theta_step_deg = 3, double phi_step_deg = 5);

/// The directions of a table.
Directions directions_of(const ReflectanceTable &table);

} // namespace tsuya

#include "tsuya/sdk/directions.h"

#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr double kSlack = 1e-9; // of angles in degrees that are sums of steps

void check_step(double step_deg, const char *where) {
    if (!(step_deg > 0 && step_deg <= 90))
        throw Error({"the step of the directions is " + std::to_string(step_deg) + " degrees",
                     where, "expected a step above 0 and up to 90"});
}

// Of the angles 0, step, 2 step and so on how many lie below the end.
std::size_t steps_below(double end_deg, double step_deg) {
    return static_cast<std::size_t>(std::ceil((end_deg - kSlack) / step_deg));
}

// Adds views every step: theta below 90, phi from 0 to phi_end; straight up once.
void add_views(Directions &directions, double theta_i_deg, double phi_i_deg, double theta_step_deg,
               double phi_step_deg, double phi_end_deg) {
    for (int i = 0; i * theta_step_deg < 90 - kSlack; ++i)
        for (int j = 0; j * phi_step_deg < phi_end_deg && (i > 0 || j == 0); ++j)
            directions.pairs.push_back({theta_i_deg * kDegree, phi_i_deg * kDegree,
                                        i * theta_step_deg * kDegree, j * phi_step_deg * kDegree});
}

} // namespace

Directions normal_incidence_quadrant(double step_deg) {
    return normal_incidence(step_deg, Symmetry::orthotropic);
}

Directions normal_incidence(double step_deg, Symmetry symmetry) {
    check_step(step_deg, "step_deg");
    Directions directions{.pairs = {}, .symmetry = symmetry};
    const double phi_end_deg = symmetry == Symmetry::orthotropic ? 90 + kSlack
                               : symmetry == Symmetry::half_turn ? 180 - kSlack
                                                                 : 360 - kSlack;
    add_views(directions, 0, 0, step_deg, step_deg, phi_end_deg);
    return directions;
}

Directions paper_directions(double theta_step_deg, double phi_step_deg) {
    check_step(theta_step_deg, "theta_step_deg");
    check_step(phi_step_deg, "phi_step_deg");
    constexpr std::size_t kLights =
        std::size_t{6} * 3; // as printed: straight down at each of its azimuths
    Directions directions;
    for (int theta_deg = 0; theta_deg < 90; theta_deg += 15)
        for (int phi_deg = 0; phi_deg <= (theta_deg > 0 ? 90 : 0); phi_deg += 45)
            add_views(directions, theta_deg, phi_deg, theta_step_deg, phi_step_deg, 360 - kSlack);
    directions.repeated =
        kLights * steps_below(90, theta_step_deg) * steps_below(360, phi_step_deg) -
        directions.pairs.size();
    return directions;
}

Directions directions_of(const ReflectanceTable &table) {
    Directions directions{.pairs = {}, .symmetry = table.symmetry};
    for (const ReflectanceRow &row : table.rows)
        directions.pairs.push_back({row.theta_i, row.phi_i, row.theta_r, row.phi_r});
    return directions;
}

} // namespace tsuya

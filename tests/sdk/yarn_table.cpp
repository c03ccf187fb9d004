#include "sdk/yarn_table.h"

#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::test {

ReflectanceTable table_of(const YarnBrdf &brdf, double theta_i_deg, double phi_i_deg) {
    const double phi_to = theta_i_deg > 0 ? 360 : 95;
    ReflectanceTable table{.symmetry = theta_i_deg > 0 ? Symmetry::none : Symmetry::orthotropic};
    for (double theta = 0; theta < 89; theta += 5)
        for (double phi = 0; phi < phi_to && (theta > 0 || phi == 0); phi += 5)
            table.rows.push_back(
                {theta_i_deg * kDegree, phi_i_deg * kDegree, theta * kDegree, phi * kDegree,
                 static_cast<double>(brdf.evaluate(glm::vec3(direction(theta_i_deg, phi_i_deg)),
                                                   glm::vec3(direction(theta, phi))))});
    return table;
}

} // namespace tsuya::test

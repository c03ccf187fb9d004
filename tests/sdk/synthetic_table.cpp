#include "sdk/synthetic_table.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tsuya::test {
namespace {

glm::dvec3 into_yarn(const glm::dvec3 &d, const YarnSystem &yarn) {
    const double c = std::cos(yarn.turn), s = std::sin(yarn.turn);
    const glm::dvec3 turned(c * d.x + s * d.y, -s * d.x + c * d.y, d.z);
    const double ct = std::cos(yarn.tilt), st = std::sin(yarn.tilt);
    return {turned.x, ct * turned.y + st * turned.z, -st * turned.y + ct * turned.z};
}

double smith_lambda(const YarnSystem &yarn, const glm::dvec3 &d) {
    const double x = yarn.alpha_weft * d.x, y = yarn.alpha_warp * d.y;
    return 0.5 * (std::sqrt(1 + (x * x + y * y) / (d.z * d.z)) - 1);
}

double facets(const YarnSystem &yarn, const glm::dvec3 &h) {
    const double x = h.x / yarn.alpha_weft, y = h.y / yarn.alpha_warp;
    const double q = x * x + y * y + h.z * h.z;
    return 1 / (std::numbers::pi * yarn.alpha_weft * yarn.alpha_warp * q * q);
}

} // namespace

glm::dvec3 direction(double theta_deg, double phi_deg) {
    const double t = theta_deg * kDegree, p = phi_deg * kDegree;
    return {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)};
}

double reflectance(const Cloth &cloth, const glm::dvec3 &to_light, const glm::dvec3 &to_viewer) {
    const double m = 1 - glm::dot(to_light, glm::normalize(to_light + to_viewer));
    const double fresnel = cloth.f0 + (1 - cloth.f0) * m * m * m * m * m;
    double sum = 0;
    for (const YarnSystem &yarn : cloth.yarns) {
        const glm::dvec3 l = into_yarn(to_light, yarn), v = into_yarn(to_viewer, yarn);
        if (!(l.z > 1e-6 && v.z > 1e-6))
            continue;
        const double masking = 1 / (1 + smith_lambda(yarn, l) + smith_lambda(yarn, v));
        sum +=
            yarn.cover * facets(yarn, glm::normalize(l + v)) * masking * fresnel / (4 * l.z * v.z);
    }
    return sum;
}

ViewGrid even_grid(double theta_step_deg, double phi_step_deg) {
    ViewGrid grid{.phi_step_deg = phi_step_deg};
    for (double theta = 0; theta <= 90; theta += theta_step_deg)
        grid.theta_deg.push_back(theta);
    return grid;
}

ReflectanceTable normal_table(const Cloth &cloth, const ViewGrid &grid) {
    ReflectanceTable table{.symmetry = cloth.symmetry};
    // The orthotropic quadrant has both its edges, the half and the whole turn only one
    const double range = cloth.symmetry == Symmetry::orthotropic ? 90 + 1e-9
                         : cloth.symmetry == Symmetry::half_turn ? 180 - 1e-9
                                                                 : 360 - 1e-9;
    for (const double theta : grid.theta_deg)
        for (double phi = 0; phi<range; phi += theta> 0 ? grid.phi_step_deg : 1000) {
            // The model is 0/0 at the horizon itself
            const glm::dvec3 view = direction(std::min(theta, 89.9), phi);
            table.rows.push_back({.theta_r = theta * kDegree,
                                  .phi_r = phi * kDegree,
                                  .brdf_per_sr = reflectance(cloth, {0, 0, 1}, view)});
        }
    return table;
}

ReflectanceTable paper_table(const Cloth &cloth, double theta_step_deg, double phi_step_deg) {
    ReflectanceTable table{.symmetry = cloth.symmetry};
    for (double theta_i = 0; theta_i < 90; theta_i += 15)
        for (double phi_i = 0; phi_i <= (theta_i > 0 ? 90 : 0); phi_i += 45)
            for (double theta = 0; theta < 90; theta += theta_step_deg)
                for (double phi = 0; phi<360; phi += theta> 0 ? phi_step_deg : 1000)
                    table.rows.push_back(
                        {theta_i * kDegree, phi_i * kDegree, theta * kDegree, phi * kDegree,
                         reflectance(cloth, direction(theta_i, phi_i), direction(theta, phi))});
    return table;
}

Cloth satin_cloth() {
    return {.yarns = {{.cover = 0.8, .alpha_weft = 0.42, .alpha_warp = 0.12},
                      {.cover = 0.2, .alpha_weft = 0.15, .alpha_warp = 0.38}}};
}

Cloth isotropic_cloth() { return {.yarns = {{.alpha_weft = 0.35, .alpha_warp = 0.35}}}; }

Cloth narrow_cloth() {
    return {.yarns = {{.cover = 1, .alpha_weft = 0.09, .alpha_warp = 0.05}}, .f0 = 0.9};
}

Cloth twisted_cloth() {
    return {.yarns = {{.alpha_weft = 0.45, .alpha_warp = 0.18, .turn = 25 * kDegree}},
            .symmetry = Symmetry::half_turn};
}

Cloth leaning_cloth() {
    return {.yarns = {{.alpha_weft = 0.4,
                       .alpha_warp = 0.2,
                       .turn = 20 * kDegree,
                       .tilt = 12 * kDegree}},
            .symmetry = Symmetry::none};
}

Bard bard_of(const Cloth &cloth) {
    double narrowest = 1;
    for (const YarnSystem &yarn : cloth.yarns)
        narrowest = std::min({narrowest, yarn.alpha_weft, yarn.alpha_warp});
    if (narrowest >= 0.1)
        return Bard::fit(normal_table(cloth, even_grid(6, 15)), BardSmoothness{}, "cloth");
    const ViewGrid grid{
        .theta_deg = {0, 1.5, 3, 4.5, 6, 8, 10, 13, 16, 20, 25, 30, 40, 50, 60, 75, 90},
        .phi_step_deg = 15};
    return Bard::fit(normal_table(cloth, grid), BardSmoothness{}, "cloth");
}

} // namespace tsuya::test

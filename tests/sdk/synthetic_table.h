#pragma once
// Reflectance tables of made-up fabrics whose exact reflectance is known.

#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::test {

// One system of parallel yarns: GGX facets in a frame that is turned about the normal and tilted
// about the weft.
struct YarnSystem {
    double cover = 1;
    double alpha_weft = 0.3, alpha_warp = 0.3;
    double turn = 0, tilt = 0; // radians
};

struct Cloth {
    std::vector<YarnSystem> yarns{};
    double f0 = 0.05;
    Symmetry symmetry = Symmetry::orthotropic;
};

// The reflectance in 1/sr of the microfacet model with Smith's masking and Schlick's Fresnel term.
double reflectance(const Cloth &cloth, const glm::dvec3 &to_light, const glm::dvec3 &to_viewer);

// Angles of the views: every theta with every phi of the domain that the symmetry leaves.
struct ViewGrid {
    std::vector<double> theta_deg{};
    double phi_step_deg = 15;
};

ViewGrid even_grid(double theta_step_deg, double phi_step_deg);

ReflectanceTable normal_table(const Cloth &cloth, const ViewGrid &grid);

// The lights of the paper's goniometer (theta_i 0 to 75 degrees in three planes) with views over
// the whole hemisphere. Orthotropic cloths only.
ReflectanceTable paper_table(const Cloth &cloth, double theta_step_deg, double phi_step_deg);

// Two crossing systems as in a warp-faced satin; one round system; one narrow lobe; twisted yarn
// that keeps the half turn only; leaning yarn that keeps nothing.
Cloth satin_cloth();
Cloth isotropic_cloth();
Cloth narrow_cloth();
Cloth twisted_cloth();
Cloth leaning_cloth();

// A surface through the cloth's views on a grid that suits it, without a search for the smoothness.
Bard bard_of(const Cloth &cloth);

glm::dvec3 direction(double theta_deg, double phi_deg);

} // namespace tsuya::test

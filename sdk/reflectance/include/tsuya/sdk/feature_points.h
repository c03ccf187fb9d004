#pragma once
/// \file
/// What the views of a fabric show of its facets: the feature points of [Takeda], and how far the
/// facets are tilted that any view shows.

#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/bard.h"

namespace tsuya {

/// A point of the BARD by which [Takeda] describes a fabric.
struct FeaturePoint {
    std::string_view name;
    double theta = 0, phi = 0; ///< of the view, radians
    double brdf_per_sr = 0;    ///< rho0 there
    double facets_per_sr = 0;  ///< D(H) of [Takeda] Eqs. 3-5 at the tilt theta/2
    bool extrapolated = false; ///< beyond the views
};

/// F0 at the normal, Fxz half way from it to the weft, and F1 to F4 in the plane of the cloth along
/// +warp, +weft, -warp and -weft; the numbers of the last four are our reading, but for F2.
/// \param f0 in (0, 1]; else throws Error
std::vector<FeaturePoint> feature_points(const Bard &bard, double f0);

/// D(H) in 1/sr of [Takeda] Eqs. 3-5, H half way between the normal and the view.
/// \param view unit, z >= 0
/// \param f0 in (0, 1]; else throws Error
double facets_of_view(const Bard &bard, double f0, const glm::dvec3 &view);

/// Largest tilt of the facets that the views show, radians: half the theta of the outermost. At
/// most 45 degrees; what models need beyond is extrapolated.
double shown_tilt(const Bard &bard);

/// Views that the surface does not meet: off by more than a tenth, by more than three times both
/// the root mean square of all and their own standard error, and by more than a thousandth of the
/// highest value measured; the worst first. The surface bends to such a view, so that neighbours
/// may be among them.
std::vector<BardView> misfits(const Bard &bard);

/// A measured view under any light beside what a model has there.
struct ModelledView {
    ReflectanceRow row{};
    double fitted_per_sr = 0;
};

/// The rows of the table that light from straight above does not belong to, beside the model.
std::vector<ModelledView> oblique_views(const ReflectanceTable &table, const BrdfFunction &model);

/// Those that the model does not meet, by the same rule as above; the worst first.
std::vector<ModelledView> misfits(std::span<const ModelledView> views);

} // namespace tsuya

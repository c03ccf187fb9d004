#pragma once
/// \file
/// Which model the views of a cloth speak for.
///
///     CarriedViews views{.bard = Bard::fit(table, "satin.csv")};
///     const std::vector<ModelScore> scores = cross_validate(table, views, "satin.csv");
///     views.model = chosen(scores);

#include <string>
#include <vector>

#include "tsuya/sdk/fabric.h"

namespace tsuya {

/// A model and how well it foretells views that it was not fitted to.
struct ModelScore {
    ViewModel model = ViewModel::yarn;
    double l2_cos = 0; ///< as ErrorMeasures::l2_cos, each view by a fit without it; no unit
};

/// Cross-validation in five folds, of the models that describe a cloth by a few parameters and so
/// are fitted, `yarn` and `ggx`: each fifth of the views with theta_i = 0 is compared with the
/// model fitted to the other four. Views that the symmetry makes equal are in one fold. Empty where
/// a fifth less is too few to fit, see Bard::fit, and where all views are 0. Throws Error naming
/// `where` as make_brdf; Interrupted where progress asks to stop. \param table the views are of its
/// rows \param views fitted to all rows of the table, with the f0 that the models take
std::vector<ModelScore> cross_validate(const ReflectanceTable &table, const CarriedViews &views,
                                       const std::string &where, const Progress &progress = {});

/// ggx where its error is less than that of yarn by 0.05 or more, else yarn: as near to the views
/// from above, yarn is nearer under oblique light. Yarn where nothing is known.
ViewModel chosen(const std::vector<ModelScore> &scores);

} // namespace tsuya

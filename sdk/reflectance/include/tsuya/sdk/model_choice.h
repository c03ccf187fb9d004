#pragma once
/// \file
/// Which model the views of a cloth ask for.
///
///     CarriedViews views{.bard = Bard::fit(table, "satin.csv")};
///     const std::vector<ModelScore> scores = cross_validate(views, "satin.csv");
///     views.model = chosen(scores);

#include <string>
#include <vector>

#include "tsuya/sdk/fabric.h"

namespace tsuya {

/// A model and how well it predicts views that it was not fitted to.
struct ModelScore {
    ViewModel model = ViewModel::yarn;
    double l2_cos = 0; ///< as ErrorMeasures::l2_cos, each view by a fit without it; no unit
};

/// Cross-validation in five folds, of the models that describe a cloth by a few parameters and so
/// are fitted, `yarn` and `ggx`: each fifth of the views of the BARD is compared with the model
/// fitted to the other four. Views that the symmetry makes equal are in one fold. Takes about two
/// seconds of a processor for 324 views. Empty where a fifth less is too few to fit, see Bard::fit,
/// and where all views are 0. Throws Error naming `where` as make_brdf; Interrupted where progress
/// asks to stop.
/// \param views those of the cloth, with the f0 that the models take; their model is not looked at
std::vector<ModelScore> cross_validate(const CarriedViews &views, const std::string &where,
                                       const Progress &progress = {});

/// ggx where its error is less than that of yarn by 0.05 or more, else yarn: as near to the views
/// from above, yarn is nearer under oblique light. Yarn where nothing is known.
ViewModel chosen(const std::vector<ModelScore> &scores);

} // namespace tsuya

#pragma once
// What tsuya fabric fit reports.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/feature_points.h"
#include "tsuya/sdk/model_choice.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya::program {

// A channel of a dyed cloth: what its body reflects.
struct BodyChannel {
    std::string name{};
    double reflectance = 0;
};

// Views under oblique light beside a model.
struct ObliqueViews {
    std::vector<ModelledView> views{};
    std::size_t lights = 0;
    double l2_cos = 0; // mean of the lights
};

// The model that the fabric was written with, on the views from above that it was fitted to.
struct WrittenModel {
    std::string name{};
    std::vector<double> fitted_per_sr{}; // of each view of the BARD
    double l2_cos = 0;
    std::vector<ModelScore> scores{}; // what chose it; empty where nothing did
};

// Shares of the plane: what a weave has of either system on its face, and what the fitted filaments
// would cover if they were level.
struct Covers {
    std::array<double, 2> on_face{}, fitted{}; // weft, warp
};

struct FitReport {
    const Bard &bard;
    WrittenModel model{};
    std::vector<BodyChannel> channels{};
    std::optional<Covers> covers{}; // none without a weave or yarns
    double f0 = 1;
    std::optional<ObliqueFit> yarn{}; // none where oblique light was not asked to be fitted
    ObliqueViews before{}, after{};
};

void print_text(const FitReport &report);
void print_json(const FitReport &report);

} // namespace tsuya::program

#include "tsuya/sdk/model_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/model.h"
#include "views/mirror_views.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr std::size_t kFolds = 5;
constexpr std::array kCandidates = {ViewModel::yarn, ViewModel::ggx};

// By which ggx must be nearer. Of a measured shade it is by 0.015, and misses twice as much as yarn
// under oblique light; of facets by 0.17 to 0.8. See sdk/docs/REFLECTANCE_STUDY.md.
constexpr double kMargin = 0.05;

// The fold of each view: every fifth of those that the symmetry leaves apart.
std::vector<std::size_t> folds_of(const Bard &bard) {
    std::vector<std::size_t> folds(bard.views().size());
    std::size_t next = 0;
    for (const MirrorGroup &group : mirror_groups(bard.views(), bard.symmetry())) {
        for (const std::size_t i : group.members)
            folds[i] = next % kFolds;
        ++next;
    }
    return folds;
}

// The views but those of one fold.
ReflectanceTable without(std::size_t fold, const std::vector<std::size_t> &folds,
                         const Bard &bard) {
    ReflectanceTable rest{.symmetry = bard.symmetry()};
    for (std::size_t i = 0; i < folds.size(); ++i)
        if (const BardView &v = bard.views()[i]; folds[i] != fold)
            rest.rows.push_back({0, 0, v.theta, v.phi, v.brdf_per_sr, v.sigma_per_sr});
    return rest;
}

// The surfaces through the views but those of each fold; empty where one has too few.
std::vector<Bard> bards_of_folds(const Bard &bard, const std::vector<std::size_t> &folds,
                                 const std::string &where, const Progress &progress) {
    std::vector<Bard> bards;
    for (std::size_t fold = 0; fold < kFolds; ++fold) {
        try {
            bards.push_back(
                Bard::fit(without(fold, folds, bard), bard.smoothness(), where, progress));
        } catch (const Error &) {
            return {};
        }
    }
    return bards;
}

} // namespace

std::vector<ModelScore> cross_validate(const CarriedViews &views, const std::string &where,
                                       const Progress &progress) {
    const Bard &bard = views.bard;
    if (!(bard.peak() > 0))
        return {};
    const std::vector<std::size_t> folds = folds_of(bard);
    const std::vector<Bard> bards = bards_of_folds(bard, folds, where, progress);
    if (bards.empty())
        return {};
    std::vector<glm::dvec3> to_viewer;
    for (const BardView &v : bard.views())
        to_viewer.push_back(direction_of(v.theta, v.phi));
    const std::vector<double> solid_angle =
        solid_angles(to_viewer, glm::dvec3(0, 0, 1), bard.symmetry());

    const auto error_of = [&](ViewModel model) {
        std::array<double, kFolds> difference{}, square{};
        tbb::parallel_for(std::size_t{0}, kFolds, [&](std::size_t fold) {
            stop_if_asked(progress);
            const auto brdf = make_brdf(
                {.specular = CarriedViews{.bard = bards[fold], .model = model, .f0 = views.f0}},
                where, progress);
            for (std::size_t i = 0; i < folds.size(); ++i) {
                if (folds[i] != fold)
                    continue;
                const glm::vec3 viewer(to_viewer[i]);
                const double measured = bard.views()[i].brdf_per_sr;
                const double found =
                    brdf ? static_cast<double>(brdf->evaluate({0, 0, 1}, viewer)) : 0;
                const double weight = solid_angle[i] * to_viewer[i].z * to_viewer[i].z;
                difference[fold] += weight * (found - measured) * (found - measured);
                square[fold] += weight * measured * measured;
            }
        });
        return std::sqrt(std::accumulate(difference.begin(), difference.end(), 0.0) /
                         std::accumulate(square.begin(), square.end(), 0.0));
    };
    std::vector<ModelScore> scores;
    for (const ViewModel model : kCandidates)
        scores.push_back({model, error_of(model)});
    return scores;
}

ViewModel chosen(const std::vector<ModelScore> &scores) {
    const auto of = [&](ViewModel model) {
        const auto found = std::ranges::find(scores, model, &ModelScore::model);
        return found == scores.end() ? std::numeric_limits<double>::infinity() : found->l2_cos;
    };
    return of(ViewModel::ggx) < of(ViewModel::yarn) - kMargin ? ViewModel::ggx : ViewModel::yarn;
}

} // namespace tsuya

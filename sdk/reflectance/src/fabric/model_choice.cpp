#include "tsuya/sdk/model_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/model.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr std::size_t kFolds = 5;
constexpr std::array kCandidates = {ViewModel::yarn, ViewModel::ggx};

// By which ggx must be nearer. Of a measured shade it is by 0.015, and misses twice as much as yarn
// under oblique light; of facets by 0.17 to 0.8. See sdk/docs/REFLECTANCE_STUDY.md.
constexpr double kMargin = 0.05;

// The same for all views that the symmetry makes equal.
std::array<long long, 2> key_of(const glm::dvec3 &d, Symmetry symmetry) {
    constexpr double kSame = 1e-5; // of the sine
    std::array<long long, 2> key{std::llround(d.x / kSame), std::llround(d.y / kSame)};
    if (symmetry == Symmetry::orthotropic)
        return {std::abs(key[0]), std::abs(key[1])};
    const std::array<long long, 2> turned{-key[0], -key[1]};
    return symmetry == Symmetry::half_turn ? std::max(key, turned) : key;
}

// The fold of each row: every fifth of the distinct views as the table lists them.
std::vector<std::size_t> folds_of(const ReflectanceTable &table) {
    std::vector<std::array<long long, 2>> seen;
    std::vector<std::size_t> folds;
    for (const ReflectanceRow &row : table.rows) {
        const auto key = key_of(row.to_viewer(), table.symmetry);
        const auto at = std::find(seen.begin(), seen.end(), key);
        folds.push_back(static_cast<std::size_t>(at - seen.begin()) % kFolds);
        if (at == seen.end())
            seen.push_back(key);
    }
    return folds;
}

// What the models make of one fold by the others, at the rows of the fold.
class FoldedModels {
  public:
    FoldedModels(const ReflectanceTable &table, const CarriedViews &views, const std::string &where,
                 const Progress &progress)
        : table_(table), folds_(folds_of(table)), views_(views), where_(where),
          progress_(progress) {}

    // Empty where a fit has too few views.
    bool fit() {
        for (std::size_t fold = 0; fold < kFolds; ++fold) {
            ReflectanceTable rest{.symmetry = table_.symmetry,
                                  .symmetry_declared = table_.symmetry_declared};
            for (std::size_t i = 0; i < table_.rows.size(); ++i)
                if (folds_[i] != fold)
                    rest.rows.push_back(table_.rows[i]);
            try {
                bards_.push_back(Bard::fit(rest, views_.bard.smoothness(), where_, progress_));
            } catch (const Error &) {
                return false;
            }
        }
        return true;
    }

    double error_of(ViewModel model, const std::vector<double> &solid_angle) const {
        std::array<double, kFolds> difference{}, square{};
        tbb::parallel_for(std::size_t{0}, kFolds, [&](std::size_t fold) {
            stop_if_asked(progress_);
            const auto brdf = make_brdf(
                {.specular = CarriedViews{.bard = bards_[fold], .model = model, .f0 = views_.f0}},
                where_, progress_);
            for (std::size_t i = 0; i < table_.rows.size(); ++i) {
                if (folds_[i] != fold)
                    continue;
                const glm::dvec3 to_viewer = table_.rows[i].to_viewer();
                const double measured = table_.rows[i].brdf_per_sr;
                const double found =
                    brdf ? static_cast<double>(brdf->evaluate({0, 0, 1}, glm::vec3(to_viewer))) : 0;
                const double weight = solid_angle[i] * to_viewer.z * to_viewer.z;
                difference[fold] += weight * (found - measured) * (found - measured);
                square[fold] += weight * measured * measured;
            }
        });
        return std::sqrt(std::accumulate(difference.begin(), difference.end(), 0.0) /
                         std::accumulate(square.begin(), square.end(), 0.0));
    }

  private:
    const ReflectanceTable &table_;
    std::vector<std::size_t> folds_;
    const CarriedViews &views_;
    const std::string &where_;
    const Progress &progress_;
    std::vector<Bard> bards_{};
};

} // namespace

std::vector<ModelScore> cross_validate(const ReflectanceTable &table, const CarriedViews &views,
                                       const std::string &where, const Progress &progress) {
    const ReflectanceTable above = table.normal_incidence();
    FoldedModels models(above, views, where, progress);
    if (!(views.bard.peak() > 0) || !models.fit())
        return {};
    std::vector<glm::dvec3> to_viewer;
    for (const ReflectanceRow &row : above.rows)
        to_viewer.push_back(row.to_viewer());
    const std::vector<double> solid_angle =
        solid_angles(to_viewer, glm::dvec3(0, 0, 1), above.symmetry);
    std::vector<ModelScore> scores;
    for (const ViewModel model : kCandidates)
        scores.push_back({model, models.error_of(model, solid_angle)});
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

#include "tsuya/sdk/feature_points.h"

#include <algorithm>
#include <cmath>

#include "models/facets.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

double log_ratio(double fitted, double measured) { return std::abs(std::log10(fitted / measured)); }

struct Met {
    double measured, fitted, sigma;
};

struct Level {
    double residual; ///< root mean square of all, log10
    double highest;  ///< of the measured values
};

bool is_off(const Met &view, const Level &all) {
    constexpr double kTimes = 3, kLeast = 0.1, kLeastOfHighest = 1e-3;
    if (!(view.measured > 0 && view.fitted > 0))
        return false;
    const double difference = std::abs(view.fitted - view.measured);
    return log_ratio(view.fitted, view.measured) > kTimes * all.residual &&
           difference > kLeast * view.measured && difference > kTimes * view.sigma &&
           difference > kLeastOfHighest * all.highest;
}

} // namespace

std::vector<FeaturePoint> feature_points(const Bard &bard, double f0) {
    std::vector<FeaturePoint> points = {{.name = "F0"},
                                        {.name = "F1", .theta = kHalfPi, .phi = kHalfPi},
                                        {.name = "F2", .theta = kHalfPi, .phi = 0},
                                        {.name = "F3", .theta = kHalfPi, .phi = 3 * kHalfPi},
                                        {.name = "F4", .theta = kHalfPi, .phi = 2 * kHalfPi},
                                        {.name = "Fxz", .theta = kHalfPi / 2, .phi = 0}};
    const double outermost = 2 * shown_tilt(bard);
    for (FeaturePoint &p : points) {
        const glm::dvec3 view = direction_of(p.theta, p.phi);
        p.brdf_per_sr = bard.at(view);
        p.facets_per_sr = facets_of_view(bard, f0, view);
        p.extrapolated = p.theta > outermost + 1e-9;
    }
    return points;
}

double facets_of_view(const Bard &bard, double f0, const glm::dvec3 &view) {
    // [Takeda] Eq. 3 for light from straight above, solved for D
    return scaled_bard(bard, checked_f0(f0), glm::vec3(view));
}

double shown_tilt(const Bard &bard) {
    double outermost = 0;
    for (const BardView &view : bard.views())
        outermost = std::max(outermost, view.theta);
    return outermost / 2;
}

std::vector<BardView> misfits(const Bard &bard) {
    std::vector<BardView> found;
    Level all{.residual = bard.residual(), .highest = 0};
    for (const BardView &view : bard.views())
        all.highest = std::max(all.highest, view.brdf_per_sr);
    for (const BardView &view : bard.views())
        if (is_off({view.brdf_per_sr, view.fitted_per_sr, view.sigma_per_sr}, all))
            found.push_back(view);
    std::stable_sort(found.begin(), found.end(), [&](const BardView &a, const BardView &b) {
        return log_ratio(a.fitted_per_sr, a.brdf_per_sr) >
               log_ratio(b.fitted_per_sr, b.brdf_per_sr);
    });
    return found;
}

std::vector<ModelledView> oblique_views(const ReflectanceTable &table, const BrdfFunction &model) {
    std::vector<ModelledView> views;
    for (const ReflectanceRow &row : table.rows)
        if (!row.from_above())
            views.push_back({row, model(row.to_light(), row.to_viewer())});
    return views;
}

std::vector<ModelledView> misfits(std::span<const ModelledView> views) {
    double squares = 0, count = 0, highest = 0;
    for (const ModelledView &view : views)
        if (view.row.brdf_per_sr > 0 && view.fitted_per_sr > 0) {
            highest = std::max(highest, view.row.brdf_per_sr);
            const double ratio = log_ratio(view.fitted_per_sr, view.row.brdf_per_sr);
            squares += ratio * ratio;
            count += 1;
        }
    const Level all{.residual = std::sqrt(squares / std::max(count, 1.0)), .highest = highest};
    std::vector<ModelledView> found;
    for (const ModelledView &view : views)
        if (is_off({view.row.brdf_per_sr, view.fitted_per_sr, view.row.sigma_per_sr}, all))
            found.push_back(view);
    std::stable_sort(found.begin(), found.end(), [&](const ModelledView &a, const ModelledView &b) {
        return log_ratio(a.fitted_per_sr, a.row.brdf_per_sr) >
               log_ratio(b.fitted_per_sr, b.row.brdf_per_sr);
    });
    return found;
}

} // namespace tsuya

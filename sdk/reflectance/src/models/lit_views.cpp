#include "models/lit_views.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tsuya {
namespace {

constexpr double kLowest = 1e-4; // cosine; a view on the horizon weighs nothing

// By which a model misses views that it is not fitted to, over their root mean square: of cloths
// that it describes well. Standard errors far below it make no view count more.
constexpr double kModelError = 0.1;

glm::dvec3 raised(const glm::dvec3 &d) { return {d.x, d.y, std::max(d.z, kLowest)}; }

// Root mean square of what the views radiate, value times cosine.
double mean_radiance(const std::vector<LitView> &views) {
    double square = 0, solid_angle = 0;
    for (const LitView &view : views) {
        square += view.solid_angle * std::pow(view.value * view.to_viewer.z, 2);
        solid_angle += view.solid_angle;
    }
    return std::sqrt(square / solid_angle);
}

} // namespace

LitViews::LitViews(const glm::dvec3 &light, const std::vector<ReflectanceRow> &rows,
                   Symmetry symmetry)
    : to_light(raised(light)) {
    std::vector<glm::dvec3> directions;
    for (const ReflectanceRow &row : rows)
        directions.push_back(raised(row.to_viewer()));
    const std::vector<double> area = solid_angles(directions, to_light, symmetry);
    for (std::size_t i = 0; i < rows.size(); ++i)
        views.push_back({directions[i], rows[i].brdf_per_sr, area[i]});
    const double expected =
        std::max(kModelError * mean_radiance(views), std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < rows.size(); ++i)
        views[i].trust = 1 / (1 + std::pow(rows[i].sigma_per_sr * directions[i].z / expected, 2));
}

void LitViews::forget_sigma() {
    for (LitView &view : views)
        view.trust = 1;
}

double LitViews::worth() const {
    double sum = 0;
    for (const LitView &view : views)
        sum += view.trust;
    return sum;
}

double LitViews::error(const BrdfFunction &model) const {
    double difference = 0, square = 0;
    for (const LitView &view : views) {
        const double weight = view.solid_angle * view.trust * std::pow(view.to_viewer.z, 2);
        difference += weight * std::pow(model(to_light, view.to_viewer) - view.value, 2);
        square += weight * view.value * view.value;
    }
    return std::sqrt(difference / std::max(square, std::numeric_limits<double>::min()));
}

} // namespace tsuya

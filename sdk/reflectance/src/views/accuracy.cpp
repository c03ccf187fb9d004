#include "tsuya/sdk/accuracy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr double kRingTheta = 60 * kDegree; // of [Takeda] Figs. 26-27
constexpr double kRingWidth = 0.01 * kDegree;
constexpr double kHorizonCosine = 1e-9;
constexpr double kLeastShareOfPeak = 0.001;
constexpr double kPercentile = 0.95;
constexpr double kAnglesPerRadian = 1e7; // light directions nearer than 1/this are one

constexpr std::array<NamedMeasure, 6> kMeasures = {{
    {"mean_over_peak", &ErrorMeasures::mean_over_peak},
    {"ring_over_peak", &ErrorMeasures::ring_over_peak},
    {"l2_cos", &ErrorMeasures::l2_cos},
    {"albedo_ratio", &ErrorMeasures::albedo_ratio},
    {"log_p95", &ErrorMeasures::log_p95},
    {"noise_floor", &ErrorMeasures::noise_floor},
}};

// theta_i and phi_i of a row as whole numbers; every phi_i is one where theta_i is 0.
std::pair<long long, long long> light_key(const ReflectanceRow &row) {
    const auto whole = [](double angle) { return std::llround(angle * kAnglesPerRadian); };
    const long long theta = whole(row.theta_i);
    const long long turn = whole(2 * kPi);
    return {theta, theta == 0 ? 0 : ((whole(row.phi_i) % turn) + turn) % turn};
}

// A row with what the model says.
struct View {
    double measured, sigma, model, theta, cosine, weight;
};

double checked(double value, const ReflectanceRow &row) {
    if (std::isfinite(value) && value >= 0)
        return value;
    const auto angles = [](double theta, double phi) {
        return "(" + std::to_string(theta / kDegree) + ", " + std::to_string(phi / kDegree) + ")";
    };
    throw Error({"the model gives " + std::to_string(value),
                 "light " + angles(row.theta_i, row.phi_i) + ", view " +
                     angles(row.theta_r, row.phi_r) + " degrees",
                 "expected a finite value not below 0"});
}

std::vector<View> make_views(const std::vector<const ReflectanceRow *> &rows, Symmetry symmetry,
                             const BrdfFunction &model) {
    const glm::dvec3 to_light = rows[0]->to_light();
    std::vector<glm::dvec3> to_viewer;
    for (const ReflectanceRow *row : rows)
        to_viewer.push_back(row->to_viewer());
    const std::vector<double> weight = solid_angles(to_viewer, to_light, symmetry);
    std::vector<View> views;
    for (std::size_t i = 0; i < rows.size(); ++i)
        views.push_back({.measured = rows[i]->brdf_per_sr,
                         .sigma = rows[i]->sigma_per_sr,
                         .model = checked(model(to_light, to_viewer[i]), *rows[i]),
                         .theta = rows[i]->theta_r,
                         .cosine = to_viewer[i].z,
                         .weight = weight[i]});
    return views;
}

// Mean of |f - m| / peak over the views that are chosen; empty where none is.
template <class Choose>
std::optional<double> over_peak(const std::vector<View> &views, double peak, Choose choose) {
    double sum = 0;
    int count = 0;
    for (const View &view : views)
        if (view.cosine > kHorizonCosine && choose(view)) {
            sum += std::abs(view.model - view.measured);
            ++count;
        }
    return count > 0 ? std::optional(sum / count / peak) : std::nullopt;
}

std::optional<double> log_percentile(const std::vector<View> &views, double peak) {
    std::vector<double> ratio;
    for (const View &view : views)
        if (view.cosine > kHorizonCosine && view.measured > kLeastShareOfPeak * peak)
            ratio.push_back(std::abs(std::log10(view.model / view.measured)));
    if (ratio.empty())
        return std::nullopt;
    const auto rank =
        static_cast<std::size_t>(std::ceil(kPercentile * static_cast<double>(ratio.size()) - 1e-9));
    const auto at = ratio.begin() + static_cast<std::ptrdiff_t>(rank - 1);
    std::nth_element(ratio.begin(), at, ratio.end());
    return *at;
}

ErrorMeasures measure(const std::vector<View> &views) {
    double peak = 0;
    for (const View &view : views)
        peak = std::max(peak, view.measured);
    if (!(peak > 0))
        return {}; // nothing was seen: every share is of 0
    ErrorMeasures error;
    error.mean_over_peak = over_peak(views, peak, [](const View &) { return true; });
    error.ring_over_peak = over_peak(views, peak, [](const View &view) {
        return std::abs(view.theta - kRingTheta) < kRingWidth;
    });
    error.log_p95 = log_percentile(views, peak);

    double difference = 0, square = 0, noise = 0, model_albedo = 0, albedo = 0;
    for (const View &view : views) {
        const double m = view.measured * view.cosine, f = view.model * view.cosine;
        const double sigma = view.sigma * view.cosine;
        difference += view.weight * (f - m) * (f - m);
        square += view.weight * m * m;
        noise += view.weight * sigma * sigma;
        model_albedo += view.weight * f;
        albedo += view.weight * m;
    }
    if (square > 0) {
        error.l2_cos = std::sqrt(difference / square);
        error.albedo_ratio = model_albedo / albedo;
        if (noise > 0)
            error.noise_floor = std::sqrt(noise / square);
    }
    return error;
}

ErrorMeasures mean_of(const std::vector<LightAccuracy> &directions) {
    ErrorMeasures mean;
    for (const NamedMeasure &measure : kMeasures) {
        double sum = 0;
        int count = 0;
        for (const LightAccuracy &direction : directions)
            if (const auto &value = direction.error.*measure.value) {
                sum += *value;
                ++count;
            }
        if (count > 0)
            mean.*measure.value = sum / count;
    }
    return mean;
}

} // namespace

std::span<const NamedMeasure> error_measures() { return kMeasures; }

Accuracy measure_accuracy(const ReflectanceTable &table, const BrdfFunction &model,
                          const Progress &progress) {
    if (table.rows.empty())
        throw Error({"the table has no row", "table", "expected measured directions"});
    std::map<std::pair<long long, long long>, std::vector<const ReflectanceRow *>> by_light;
    for (const ReflectanceRow &row : table.rows)
        by_light[light_key(row)].push_back(&row);
    Accuracy accuracy;
    std::vector<const std::vector<const ReflectanceRow *> *> groups;
    for (const auto &[key, rows] : by_light) {
        groups.push_back(&rows);
        accuracy.directions.push_back(
            {.theta_i = rows[0]->theta_i,
             .phi_i = key.second == 0 ? 0.0 : std::fmod(rows[0]->phi_i + 4 * kPi, 2 * kPi),
             .views = rows.size()});
    }
    tbb::parallel_for(std::size_t{0}, groups.size(), [&](std::size_t i) {
        stop_if_asked(progress);
        accuracy.directions[i].error = measure(make_views(*groups[i], table.symmetry, model));
    });
    accuracy.mean = mean_of(accuracy.directions);
    return accuracy;
}

} // namespace tsuya

#include "tsuya/sdk/accuracy.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <tbb/parallel_for.h>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"
#include "views/lights.h"
#include "views/stop.h"

namespace tsuya {
namespace {

constexpr double kRingTheta = 60 * kDegree; // of [Takeda] Figs. 26-27
constexpr double kRingWidth = 0.5 * kDegree;
constexpr double kRingsApart = 20 * kDegree;    // of two that are interpolated between
constexpr double kAzimuthsApart = 45 * kDegree; // of two views of a ring, the same
constexpr double kHorizonCosine = 1e-9;
constexpr double kLeastShareOfPeak = 0.001;
constexpr double kPercentile = 0.95;

constexpr std::array<NamedMeasure, 6> kMeasures = {{
    {"mean_over_peak", &ErrorMeasures::mean_over_peak},
    {"ring_over_peak", &ErrorMeasures::ring_over_peak},
    {"l2_cos", &ErrorMeasures::l2_cos},
    {"albedo_ratio", &ErrorMeasures::albedo_ratio},
    {"log_p95", &ErrorMeasures::log_p95},
    {"noise_floor", &ErrorMeasures::noise_floor},
}};

// A row with what the model says.
struct View {
    double measured, sigma, model, theta, phi, cosine, weight;

    double difference() const { return model - measured; }
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

std::vector<View> make_views(const std::vector<ReflectanceRow> &rows,
                             const std::vector<double> &solid_angle, const BrdfFunction &model) {
    const glm::dvec3 to_light = rows[0].to_light();
    std::vector<View> views;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const glm::dvec3 to_viewer = rows[i].to_viewer();
        views.push_back({.measured = rows[i].brdf_per_sr,
                         .sigma = rows[i].sigma_per_sr,
                         .model = checked(model(to_light, to_viewer), rows[i]),
                         .theta = rows[i].theta_r,
                         .phi = rows[i].phi_r,
                         .cosine = to_viewer.z,
                         .weight = solid_angle[i]});
    }
    return views;
}

// Mean of |f - m| / peak over the views that are chosen; empty where none is.
template <class Choose>
std::optional<double> over_peak(const std::vector<View> &views, double peak, Choose choose) {
    double sum = 0;
    int count = 0;
    for (const View &view : views)
        if (view.cosine > kHorizonCosine && choose(view)) {
            sum += std::abs(view.difference());
            ++count;
        }
    return count > 0 ? std::optional(sum / count / peak) : std::nullopt;
}

// The views of the ring that holds `theta`, by azimuth.
std::vector<View> ring_at(const std::vector<View> &views, double theta) {
    std::vector<View> ring;
    for (const View &view : views)
        if (std::abs(view.theta - theta) < kRingWidth) {
            ring.push_back(view);
            ring.back().phi -= 2 * kPi * std::floor(view.phi / (2 * kPi));
        }
    std::sort(ring.begin(), ring.end(), [](const View &a, const View &b) { return a.phi < b.phi; });
    return ring;
}

// f - m of a ring at an azimuth, between its neighbours.
std::optional<double> difference_at(const std::vector<View> &ring, double phi) {
    constexpr double kSame = 1e-6;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const View &a = ring[i], &b = ring[(i + 1) % ring.size()];
        const double turn = 2 * kPi;
        const double at = std::fmod(phi - a.phi + kSame + turn, turn) - kSame;
        const double gap = std::fmod(b.phi - a.phi + turn, turn);
        if (at < kSame)
            return a.difference();
        if (at < gap && gap < kAzimuthsApart)
            return std::lerp(a.difference(), b.difference(), at / gap);
    }
    return std::nullopt;
}

// As over_peak, on a ring between two that were measured.
std::optional<double> interpolated_ring(const std::vector<View> &views, double peak) {
    double below = 0, above = kPi / 2;
    for (const View &view : views) {
        if (view.theta < kRingTheta)
            below = std::max(below, view.theta);
        else if (view.cosine > kHorizonCosine)
            above = std::min(above, view.theta);
    }
    if (above - below > kRingsApart)
        return std::nullopt;
    const std::vector<View> lower = ring_at(views, below), upper = ring_at(views, above);
    const double share = (kRingTheta - below) / (above - below);
    double sum = 0;
    int count = 0;
    for (const View &view : lower)
        if (const auto beyond = difference_at(upper, view.phi)) {
            sum += std::abs(std::lerp(view.difference(), *beyond, share));
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
    if (!error.ring_over_peak)
        error.ring_over_peak = interpolated_ring(views, peak);
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

TableAccuracy::TableAccuracy(const ReflectanceTable &table, const Progress &progress) {
    if (table.rows.empty())
        throw Error({"the table has no row", "table", "expected measured directions"});
    std::vector<std::vector<ReflectanceRow>> lights = rows_by_light(table);
    std::vector<std::vector<double>> solid_angle =
        solid_angles_by_light(lights, table.symmetry, progress);
    for (std::size_t i = 0; i < lights.size(); ++i)
        lights_.push_back({std::move(lights[i]), std::move(solid_angle[i])});
}

Accuracy TableAccuracy::of(const BrdfFunction &model, const Progress &progress) const {
    Accuracy accuracy;
    for (const Light &light : lights_) {
        const ReflectanceRow &first = light.rows[0];
        const bool above = first.from_above();
        accuracy.directions.push_back(
            {.theta_i = above ? 0.0 : first.theta_i,
             .phi_i = above ? 0.0 : std::fmod(first.phi_i + 4 * kPi, 2 * kPi),
             .views = light.rows.size()});
    }
    tbb::parallel_for(std::size_t{0}, lights_.size(), [&](std::size_t i) {
        stop_if_asked(progress);
        accuracy.directions[i].error =
            measure(make_views(lights_[i].rows, lights_[i].solid_angle, model));
    });
    accuracy.mean = mean_of(accuracy.directions);
    return accuracy;
}

bool TableAccuracy::only_from_above() const {
    return std::ranges::all_of(lights_,
                               [](const Light &light) { return light.rows[0].from_above(); });
}

Accuracy measure_accuracy(const ReflectanceTable &table, const BrdfFunction &model,
                          const Progress &progress) {
    return TableAccuracy(table, progress).of(model, progress);
}

} // namespace tsuya

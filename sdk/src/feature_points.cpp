#include "tsuya/sdk/feature_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "facets.h"

namespace tsuya {
namespace {

constexpr double kHalfPi = std::numbers::pi / 2;

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
        const glm::dvec3 view(std::sin(p.theta) * std::cos(p.phi),
                              std::sin(p.theta) * std::sin(p.phi),
                              std::max(0.0, std::cos(p.theta)));
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
    constexpr double kTimes = 3, kLeast = 0.1;
    const auto off_by = [](const BardView &view) {
        return std::abs(std::log10(view.fitted_per_sr / view.brdf_per_sr));
    };
    std::vector<BardView> found;
    const double residual = bard.residual();
    for (const BardView &view : bard.views()) {
        if (!(view.brdf_per_sr > 0 && view.fitted_per_sr > 0))
            continue;
        const double difference = std::abs(view.fitted_per_sr - view.brdf_per_sr);
        if (off_by(view) > kTimes * residual && difference > kLeast * view.brdf_per_sr &&
            difference > kTimes * view.sigma_per_sr)
            found.push_back(view);
    }
    std::stable_sort(found.begin(), found.end(),
                     [&](const BardView &a, const BardView &b) { return off_by(a) > off_by(b); });
    return found;
}

} // namespace tsuya

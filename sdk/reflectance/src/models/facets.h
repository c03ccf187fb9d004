#pragma once
// What the microfacet models share.

#include <algorithm>
#include <cmath>
#include <string>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/detail/brdf_core.h"
#include "tsuya/sdk/detail/disk_table.h"
#include "views/stop.h"

namespace tsuya {

// [Takeda] Eq. 5
inline float fresnel(float f0, float cosine) {
    const float m = 1 - cosine, m2 = m * m;
    return f0 + (1 - f0) * m2 * m2 * m;
}

// Throws Error naming `where` if f0 is not in (0, 1]: at 0 the reflectance of all facets but the
// grazing ones would be carried from nothing.
float checked_f0(double f0, const std::string &where = "f0");

// The part of the regular form that V0 alone decides: rho0(V0) max(cos theta0, 1/2) /
// F(cos(theta0/2)).
float scaled_bard(const Bard &bard, float f0, const glm::vec3 &basic);
DiskTable scaled_bard(const Bard &bard, float f0, int nodes, const Progress &progress);

// Points of the R2 sequence [Roberts] and a third coordinate by the golden ratio of it.
inline glm::vec3 quadrature_point(int i) {
    const double n = i + 0.5;
    const auto fraction = [](double x) { return static_cast<float>(x - std::floor(x)); };
    return {fraction(n * 0.8191725133961645), fraction(n * 0.6710436067037893),
            fraction(n * 0.5497004779019703)};
}

// Mean weight of what `sample` gives at the quadrature points: an albedo. Throws Interrupted.
template <class Sample>
float mean_weight(const Sample &sample, const Progress &progress, int samples) {
    stop_if_asked(progress);
    double sum = 0;
    for (int i = 0; i < samples; ++i)
        if (const auto s = sample(quadrature_point(i)))
            sum += s->weight;
    return static_cast<float>(sum / samples);
}

// The same of a core's own samples: its albedo of a light, and of a view.
template <class Core>
float mean_weight_of_views(const Core &core, const glm::vec3 &to_light, const Progress &progress,
                           int samples = 1024) {
    return mean_weight([&](const glm::vec3 &u) { return detail::sample_view(core, to_light, u); },
                       progress, samples);
}
template <class Core>
float mean_weight_of_lights(const Core &core, const glm::vec3 &to_viewer, const Progress &progress,
                            int samples = 1024) {
    return mean_weight([&](const glm::vec3 &u) { return detail::sample_light(core, to_viewer, u); },
                       progress, samples);
}

// rho cos_i cos_r = value * min(1, k cos_i, k cos_r): microfacets with V-grooves in the form that
// stays regular at grazing.
struct FacetTerms {
    float value;
    float k; // 2 N.H / V.H

    // Of [Takeda] Eq. 14, from what the table of `scaled_bard` has at V0
    static FacetTerms scaled(float at_basic, float f0, const glm::vec3 &to_light,
                             const glm::vec3 &to_viewer) {
        // 1 + L.V without the cancellation where they are opposite
        constexpr float kSmallest = 1e-20f;
        const glm::vec3 both = to_light + to_viewer;
        const float sum = std::max(0.5f * glm::dot(both, both), kSmallest);
        const float light_half = std::sqrt(std::min(0.5f * sum, 1.0f)); // L.H
        return {at_basic * fresnel(f0, light_half), 2 * (to_light.z + to_viewer.z) / sum};
    }

    // rho
    float per_sr(float cos_i, float cos_r) const {
        return value * std::min({1 / (cos_i * cos_r), k / cos_r, k / cos_i});
    }
    // rho times the first cosine
    float cos(float first, float second) const {
        return value * std::min({1 / second, k, k * first / second});
    }
};

} // namespace tsuya

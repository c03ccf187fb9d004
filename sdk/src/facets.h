#pragma once
// What the microfacet models share.

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace tsuya {

// [Takeda] Eq. 5
inline float fresnel(float f0, float cosine) {
    const float m = 1 - cosine, m2 = m * m;
    return f0 + (1 - f0) * m2 * m2 * m;
}

// Points of the R2 sequence [Roberts] and a third coordinate by the golden ratio of it.
inline glm::vec3 quadrature_point(int i) {
    const double n = i + 0.5;
    const auto fraction = [](double x) { return static_cast<float>(x - std::floor(x)); };
    return {fraction(n * 0.8191725133961645), fraction(n * 0.6710436067037893),
            fraction(n * 0.5497004779019703)};
}

// rho cos_i cos_r = value * min(1, k cos_i, k cos_r): microfacets with V-grooves in the form that
// stays regular at grazing.
struct FacetTerms {
    float value;
    float k; // 2 N.H / V.H

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

#include "rough_surface.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
CosineLobe::CosineLobe(std::vector<double> g) : g_(std::move(g)) {
    largest_ = *std::max_element(g_.begin(), g_.end());
    constexpr int kSteps = 1 << 14;
    for (int i = 0; i < kSteps; ++i) { // the midpoint rule in x = sqrt(mu)
        const double x = (i + 0.5) / kSteps;
        integral_ += value(x * x) * x * x * 2 * x;
    }
    integral_ *= 2 * kPi / kSteps;
    scale_ = integral_ > 0 ? 1 / integral_ : 0;
}

double CosineLobe::value(double mu) const {
    const double x = std::sqrt(std::clamp(mu, 0.0, 1.0)) * static_cast<double>(g_.size() - 1);
    const std::size_t k = std::min(static_cast<std::size_t>(x), g_.size() - 2);
    const double f = x - static_cast<double>(k);
    return g_[k] * (1 - f) + g_[k + 1] * f;
}

double CosineLobe::sample(Random &random) const {
    for (;;) {
        const double mu = std::sqrt(random.open_unit());
        if (random.unit() * largest_ <= value(mu))
            return mu;
    }
}

RoughSurface::RoughSurface(const FilamentOptics &optics)
    : facets_(optics.surface_roughness), index_(optics.refractive_index),
      lost_(CosineLobe::tabulate([&](double mu) { return std::max(0.0, 1 - single_albedo(mu)); })) {
}

double RoughSurface::single_albedo(double mu) const {
    const double own = facets_.lambda(mu);
    double sum = 0;
    facets_.each_facing(mu, [&](double shown, double cosine, double height) {
        const double up = 2 * cosine * height - mu;
        if (up > 0)
            sum += shown / (mu * (1 + own + facets_.lambda(up)));
    });
    return sum * Facets::kCell;
}

RoughSurface::Reflection RoughSurface::sample(const glm::vec3 &from, Random &random) const {
    const double mu = from.z;
    const glm::vec3 m = facets_.visible_normal(from, random);
    const float cosine = std::max(0.0f, glm::dot(from, m));
    const glm::vec3 to = 2 * cosine * m - from;
    if (to.z > 0) {
        const double own = 1 + facets_.lambda(mu);
        const double other = facets_.lambda(to.z);
        if (other == 0 || random.unit() * (own + other) < own)
            return {to, fresnel(cosine, index_)};
    }
    const double mu_to = lost_.sample(random);
    const double r = std::sqrt(1 - mu_to * mu_to), phi = 2 * kPi * random.unit();
    return {glm::vec3(r * std::cos(phi), r * std::sin(phi), mu_to),
            fresnel(mu, index_) * fresnel(mu_to, index_)};
}

double RoughSurface::single_per_sr(const glm::vec3 &from, const glm::vec3 &to) const {
    if (to.z <= 0)
        return 0;
    const glm::dvec3 h = glm::normalize(glm::dvec3(from) + glm::dvec3(to));
    const double g = 1 / (1 + facets_.lambda(from.z) + facets_.lambda(to.z));
    // [Walter] Eq. 20, times the cosine of `to`
    return fresnel(glm::dot(glm::dvec3(from), h), index_) * facets_.density(h.z) * g / (4 * from.z);
}

double RoughSurface::multiple_per_sr(double mu_from, double mu_to) const {
    if (mu_to <= 0)
        return 0;
    // Differs from [KullaConty]: two boundaries are met, each in its own direction, so that their
    // Fresnel terms stand for the mean one.
    return lost_.value(mu_from) * lost_.per_sr(mu_to) * fresnel(mu_from, index_) *
           fresnel(mu_to, index_);
}

} // namespace tsuya::lab

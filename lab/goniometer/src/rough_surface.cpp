#include "rough_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr std::size_t kNodes = 128;    // of a lobe's table
constexpr double kSmoothCotangent = 4; // of a direction whose shadowing is below 1e-8

double node(std::size_t k) {
    const double x = static_cast<double>(k) / (kNodes - 1);
    return std::max(x * x, 1e-6);
}

} // namespace

double fresnel(double cosine, double refractive_index) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    const double g = std::sqrt(refractive_index * refractive_index - 1 + c * c);
    if (g + c <= 0)
        return 1;
    const double s = (g - c) / (g + c);
    const double p = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * s * s * (1 + p * p); // [Walter] Eq. 22
}

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
    : slope_(optics.surface_roughness), index_(optics.refractive_index),
      transmission_(optics.transmission) {
    std::vector<double> lost(kNodes), single(kNodes), enters(kNodes);
    for (std::size_t k = 0; k < kNodes; ++k) {
        const glm::dvec2 albedo = single_albedo(node(k));
        lost[k] = std::max(0.0, 1 - albedo.x);
        single[k] = albedo.y;
    }
    lost_ = CosineLobe(lost);
    std::vector<double> reflected(kNodes);
    for (std::size_t k = 0; k < kNodes; ++k)
        reflected[k] = lost[k] * fresnel(node(k), index_);
    const double mean =
        lost_.integral() > 0 ? CosineLobe(reflected).integral() / lost_.integral() : 0;
    for (std::size_t k = 0; k < kNodes; ++k)
        enters[k] = std::max(0.0, 1 - single[k] - reflected[k] * mean);
    exit_ = CosineLobe(enters);
}

double RoughSurface::lambda(double mu) const {
    const double sine = std::sqrt(std::max(0.0, 1 - mu * mu));
    if (mu >= kSmoothCotangent * std::numbers::sqrt2 * slope_ * sine)
        return 0;
    // [Heitz] Eq. 64
    const double a = mu / (std::numbers::sqrt2 * slope_ * sine);
    return std::max(0.0, 0.5 * (std::exp(-a * a) / (a * std::sqrt(kPi)) - std::erfc(a)));
}

glm::vec2 RoughSurface::visible_slopes(double mu, Random &random) const {
    // The density of normal slopes times max(0, c + k z): drawn from that of normal(z) (c + k z+),
    // which is never smaller.
    const double c = mu, k = slope_ * std::sqrt(std::max(0.0, 1 - mu * mu));
    const double half_mean = k / std::sqrt(2 * kPi);
    for (;;) {
        const glm::vec2 z = random.normal();
        if (random.unit() * (c + half_mean) >= c)
            return {std::sqrt(-2 * std::log(random.open_unit())), z.y};
        if (z.x >= 0 || random.unit() * c < c + k * z.x)
            return z;
    }
}

glm::dvec2 RoughSurface::single_albedo(double mu) const {
    constexpr int kSteps = 96;
    constexpr double kReach = 6; // standard deviations
    const double sine = std::sqrt(std::max(0.0, 1 - mu * mu)), own = lambda(mu);
    const double step = 2 * kReach / kSteps;
    glm::dvec2 sum{0, 0};
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps / 2; ++j) { // symmetric across the plane of incidence
            const glm::dvec2 z{(i + 0.5) * step - kReach, (j + 0.5) * step};
            const double facing = mu + sine * slope_ * z.x;
            if (facing <= 0)
                continue;
            const glm::dvec3 m = glm::normalize(glm::dvec3(slope_ * z, 1.0));
            const double cosine = m.x * sine + m.z * mu;
            const double up = 2 * cosine * m.z - mu;
            if (up <= 0)
                continue;
            const double density = std::exp(-0.5 * glm::dot(z, z)) / kPi; // of both halves
            const double seen = density * facing / (mu * (1 + own + lambda(up)));
            sum += seen * glm::dvec2(1, fresnel(cosine, index_));
        }
    return sum * step * step;
}

RoughSurface::Reflection RoughSurface::sample(const glm::vec3 &from, Random &random) const {
    const double mu = from.z;
    const glm::vec2 z = visible_slopes(mu, random) * static_cast<float>(slope_);
    const float sine = std::sqrt(std::max(0.0f, 1 - from.z * from.z));
    const glm::vec2 along = sine > 1e-7f ? glm::vec2(from.x, from.y) / sine : glm::vec2(1, 0);
    const glm::vec2 s = along * z.x + glm::vec2(-along.y, along.x) * z.y;
    const glm::vec3 m = glm::normalize(glm::vec3(s, 1));
    const float cosine = std::max(0.0f, glm::dot(from, m));
    const glm::vec3 to = 2 * cosine * m - from;
    if (to.z > 0) {
        const double own = 1 + lambda(mu);
        if (const double other = lambda(to.z); other == 0 || random.unit() * (own + other) < own)
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
    const double cosine2 = h.z * h.z, variance = slope_ * slope_;
    const double d = std::exp(-(1 - cosine2) / (cosine2 * 2 * variance)) /
                     (2 * kPi * variance * cosine2 * cosine2);
    const double g = 1 / (1 + lambda(from.z) + lambda(to.z));
    // [Walter] Eq. 20, times the cosine of `to`
    return fresnel(glm::dot(glm::dvec3(from), h), index_) * d * g / (4 * from.z);
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

#include "rough_dielectric.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr double kSteepest = 5; // standard deviations; 3e-7 of the facets are steeper

glm::vec3 direction_with(double mu, Random &random) {
    const double r = std::sqrt(std::max(0.0, 1 - mu * mu)), phi = 2 * kPi * random.unit();
    return {r * std::cos(phi), r * std::sin(phi), mu};
}

} // namespace

RoughDielectric::RoughDielectric(const FilamentOptics &optics, const RoughSurface &surface,
                                 Normals normals)
    : facets_(optics.surface_roughness), index_(optics.refractive_index), normals_(normals),
      lost_(surface.lost()) {
    for (const Side side : {Side::outside, Side::inside}) {
        const std::size_t s = side == Side::inside ? 1 : 0;
        const double n = index_ratio(side);
        const CosineLobe reflected =
            CosineLobe::tabulate([&](double mu) { return lost_.value(mu) * fresnel(mu, n); });
        mean_[s] = lost_.integral() > 0 ? reflected.integral() / lost_.integral() : 0;
        rest_[s] = CosineLobe::tabulate([&](double mu) {
            return std::max(0.0, 1 - single_albedo(mu, side) -
                                     lost_.value(mu) * fresnel(mu, n) * mean_[s]);
        });
    }
    const double out = rest_[0].integral(), in = index_ * index_ * rest_[1].integral();
    outside_share_ = out + in > 0 ? out / (out + in) : 0;
}

double RoughDielectric::single_albedo(double mu, Side side) const {
    const double own = facets_.lambda(mu), n = index_ratio(side);
    double sum = 0;
    facets_.each_facing(mu, [&](double shown, double cosine, double height) {
        const double f = fresnel(cosine, n);
        const double up = 2 * cosine * height - mu;
        if (up > 0)
            sum += shown * f / (mu * (1 + own + facets_.lambda(up)));
        if (f >= 1)
            return;
        const double beyond = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
        const double down = mu / n - (cosine / n - beyond) * height;
        if (down > 0)
            sum += shown * (1 - f) / (mu * (1 + own) * (1 + facets_.lambda(down)));
    });
    return sum * Facets::kCell;
}

RoughDielectric::Passage RoughDielectric::sample(const glm::vec3 &from, Side side,
                                                 Random &random) const {
    glm::vec3 m;
    float cosine;
    do {
        m = normals_ == Normals::visible ? facets_.visible_normal(from, random)
                                         : facets_.any_normal(random);
        cosine = glm::dot(from, m);
    } while (cosine <= 0);
    const double n = index_ratio(side);
    if (random.unit() < fresnel(cosine, n)) {
        const glm::vec3 to = 2 * cosine * m - from;
        if (to.z > 0) {
            const double own = 1 + facets_.lambda(from.z), other = facets_.lambda(to.z);
            if (other == 0 || random.unit() * (own + other) < own)
                return {to, false};
        }
        return sample_lost(from.z, side, random);
    }
    const auto ratio = static_cast<float>(1 / n);
    const float beyond =
        std::sqrt(std::max(0.0f, 1 - ratio * ratio * std::max(0.0f, 1 - cosine * cosine)));
    const glm::vec3 to = glm::normalize((ratio * cosine - beyond) * m - ratio * from);
    if (to.z < 0) {
        const double other = facets_.lambda(-to.z);
        if (other == 0 || random.unit() * (1 + other) < 1)
            return {to, true};
    }
    return sample_lost(from.z, side, random);
}

RoughDielectric::Passage RoughDielectric::sample_lost(double mu, Side side, Random &random) const {
    const double n = index_ratio(side);
    const double reflected = lost_.value(mu) * fresnel(mu, n) * mean_[side == Side::inside ? 1 : 0];
    const double other = rest(side).value(mu);
    if (random.unit() * (reflected + other) < reflected)
        for (;;) { // the lobe of several reflections, times Fresnel's term
            const double mu_to = lost_.sample(random);
            if (random.unit() < fresnel(mu_to, n))
                return {direction_with(mu_to, random), false};
        }
    const Side to_side = random.unit() < outside_share_ ? Side::outside : Side::inside;
    glm::vec3 to = direction_with(rest(to_side).sample(random), random);
    const bool through = to_side != side;
    to.z = through ? -to.z : to.z;
    return {to, through};
}

double RoughDielectric::through_per_sr(const glm::vec3 &from, const glm::vec3 &to,
                                       Side side) const {
    if (to.z >= 0)
        return 0;
    const double n = index_ratio(side);
    glm::dvec3 m = -(glm::dvec3(from) + n * glm::dvec3(to)); // [Walter] Eq. 16
    m = glm::normalize(m.z < 0 ? -m : m);
    const double i = glm::dot(glm::dvec3(from), m), o = glm::dot(glm::dvec3(to), m);
    if (i <= 0 || o >= 0)
        return 0;
    const double g = 1 / ((1 + facets_.lambda(from.z)) * (1 + facets_.lambda(-to.z)));
    // [Walter] Eq. 21, times the cosine of `to`
    const double across = i + n * o;
    return -i * o * n * n * (1 - fresnel(i, n)) * g * facets_.density(m.z) /
           (from.z * across * across);
}

glm::vec3 RoughDielectric::refracted(const glm::vec3 &from, Side side) const {
    const auto ratio = static_cast<float>(1 / index_ratio(side));
    glm::vec3 to = -ratio * from;
    const float sine2 = to.x * to.x + to.y * to.y;
    to.z = -std::sqrt(std::max(0.0f, 1 - sine2));
    return glm::normalize(to);
}

bool RoughDielectric::passes(const glm::vec3 &from, Side side) const {
    const double n = index_ratio(side);
    if (n >= 1)
        return true;
    const double angle = std::acos(std::min(1.0f, from.z)) - kSteepest * facets_.slope();
    return std::sin(std::max(0.0, angle)) < n;
}

} // namespace tsuya::lab

#include "facets.h"

#include <algorithm>
#include <numbers>

namespace tsuya::lab {
namespace {

constexpr double kSmoothCotangent = 4; // of a direction whose shadowing is below 1e-8

} // namespace

double fresnel(double cosine, double refractive_index) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    const double g = std::sqrt(std::max(0.0, refractive_index * refractive_index - 1 + c * c));
    if (g <= 0)
        return 1;
    const double s = (g - c) / (g + c);
    const double p = (c * (g + c) - 1) / (c * (g - c) + 1);
    return 0.5 * s * s * (1 + p * p); // [Walter] Eq. 22
}

double Facets::lambda(double mu) const {
    const double sine = std::sqrt(std::max(0.0, 1 - mu * mu));
    if (mu >= kSmoothCotangent * std::numbers::sqrt2 * slope_ * sine)
        return 0;
    // [Heitz] Eq. 64
    const double a = mu / (std::numbers::sqrt2 * slope_ * sine);
    return std::max(0.0, 0.5 * (std::exp(-a * a) / (a * std::sqrt(kPi)) - std::erfc(a)));
}

double Facets::density(double cosine) const {
    const double cosine2 = cosine * cosine, variance = slope_ * slope_;
    return std::exp(-(1 - cosine2) / (cosine2 * 2 * variance)) /
           (2 * kPi * variance * cosine2 * cosine2);
}

glm::vec2 Facets::visible_slopes(double mu, Random &random) const {
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

glm::vec3 Facets::visible_normal(const glm::vec3 &from, Random &random) const {
    const glm::vec2 z = visible_slopes(from.z, random) * static_cast<float>(slope_);
    const float sine = std::sqrt(std::max(0.0f, 1 - from.z * from.z));
    const glm::vec2 along = sine > 1e-7f ? glm::vec2(from.x, from.y) / sine : glm::vec2(1, 0);
    const glm::vec2 s = along * z.x + glm::vec2(-along.y, along.x) * z.y;
    return glm::normalize(glm::vec3(s, 1));
}

glm::vec3 Facets::any_normal(Random &random) const {
    return glm::normalize(glm::vec3(random.normal() * static_cast<float>(slope_), 1));
}

} // namespace tsuya::lab

#include "light_sphere.h"

#include <cmath>

#include "direction_cone.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {

LightSphere::LightSphere(const SphereLight &light, const glm::dvec3 &centre)
    : centre_(light.centre - centre), radius_(static_cast<float>(light.radius)),
      radiance_(static_cast<float>(light.radiance)) {}

double LightSphere::highest_intensity() const {
    return kPi * static_cast<double>(radiance_) * static_cast<double>(radius_) *
           static_cast<double>(radius_);
}

LightBounds LightSphere::bounds(float power) const {
    return {centre_ - radius_, centre_ + radius_, {.cos_spread = -1}, power};
}

std::optional<LightRay> LightSphere::sample(const glm::vec3 &from, glm::vec2 u) const {
    const glm::vec3 to_centre = centre_ - from;
    const float distance2 = glm::dot(to_centre, to_centre), radius2 = radius_ * radius_;
    if (!(distance2 > radius2))
        return std::nullopt;
    const float distance = std::sqrt(distance2);
    const float wide = one_minus_cosine(radius2 / distance2);
    const glm::vec3 to_light = sample_cone(to_centre / distance, wide, u);
    const float along = glm::dot(to_light, to_centre);
    const glm::vec3 aside = to_centre - along * to_light;
    const float in = std::sqrt(std::max(0.0f, radius2 - glm::dot(aside, aside)));
    return LightRay{to_light, along - in, radiance_, cone_pdf(wide)};
}

std::optional<float> LightSphere::crossing(const glm::vec3 &from,
                                           const glm::vec3 &direction) const {
    const glm::vec3 to_centre = centre_ - from;
    const float radius2 = radius_ * radius_, along = glm::dot(direction, to_centre);
    if (!(along > 0) || !(glm::dot(to_centre, to_centre) > radius2))
        return std::nullopt;
    const glm::vec3 aside = to_centre - along * direction;
    const float in2 = radius2 - glm::dot(aside, aside);
    if (!(in2 >= 0))
        return std::nullopt;
    return along - std::sqrt(in2);
}

float LightSphere::pdf(const glm::vec3 &from, const glm::vec3 &, float) const {
    const glm::vec3 to_centre = centre_ - from;
    return cone_pdf(one_minus_cosine(radius_ * radius_ / glm::dot(to_centre, to_centre)));
}

} // namespace tsuya

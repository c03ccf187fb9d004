#include "light_point.h"

#include <cmath>

#include "cone_falloff.h"

namespace tsuya {
namespace {

// What rounding may add to an angle, radians.
constexpr float kRounding = 1e-3f;

} // namespace

LightPoint::LightPoint(const PointLight &light, const glm::dvec3 &centre)
    : position_(light.position - centre), axis_(glm::normalize(light.direction)),
      intensity_(static_cast<float>(light.intensity)),
      cos_full_(static_cast<float>(std::cos(light.full_angle))),
      cos_cone_(static_cast<float>(std::cos(light.cone_angle))) {}

LightBounds LightPoint::bounds(float power) const {
    return {position_, position_, {axis_, cos_cone_, std::cos(kRounding)}, power};
}

std::optional<LightRay> LightPoint::sample(const glm::vec3 &from, glm::vec2) const {
    const glm::vec3 offset = position_ - from;
    const float distance2 = glm::dot(offset, offset);
    if (!(distance2 > 0))
        return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 to_light = offset / distance;
    const float share = cone_falloff(-glm::dot(to_light, axis_), cos_full_, cos_cone_);
    if (!(share > 0))
        return std::nullopt;
    return LightRay{to_light, distance, intensity_ * share / distance2, kOnlyDirection};
}

} // namespace tsuya

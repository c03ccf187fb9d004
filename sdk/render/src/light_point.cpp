#include "light_point.h"

#include <algorithm>
#include <cmath>

#include "cone_falloff.h"
#include "profile_frame.h"

namespace tsuya {
namespace {

// What rounding may add to an angle, radians.
constexpr float kRounding = 1e-3f;

} // namespace

LightPoint::LightPoint(const PointLight &light, const glm::dvec3 &centre)
    : position_(light.position - centre), axis_(glm::normalize(light.direction)),
      intensity_(static_cast<float>(light.intensity)),
      cos_full_(static_cast<float>(std::cos(light.full_angle))),
      cos_cone_(static_cast<float>(std::cos(light.cone_angle))) {
    if (!light.profile)
        return;
    profile_ = &*light.profile;
    const ProfileFrame frame(light);
    zero_ = frame.zero;
    quarter_ = frame.quarter;
}

LightBounds LightPoint::bounds(float power) const {
    const float cos_last = profile_ ? static_cast<float>(std::cos(profile_->last_angle())) : -1.0f;
    return {
        position_, position_, {axis_, std::max(cos_cone_, cos_last), std::cos(kRounding)}, power};
}

float LightPoint::candela(const glm::vec3 &away) const {
    if (!profile_)
        return 1;
    const float vertical = std::acos(std::clamp(glm::dot(away, axis_), -1.0f, 1.0f));
    const float horizontal = std::atan2(glm::dot(away, quarter_), glm::dot(away, zero_));
    return static_cast<float>(
        profile_->at(static_cast<double>(vertical), static_cast<double>(horizontal)));
}

std::optional<LightRay> LightPoint::sample(const glm::vec3 &from, glm::vec2) const {
    const glm::vec3 offset = position_ - from;
    const float distance2 = glm::dot(offset, offset);
    if (!(distance2 > 0))
        return std::nullopt;
    const float distance = std::sqrt(distance2);
    const glm::vec3 to_light = offset / distance;
    const float share =
        cone_falloff(-glm::dot(to_light, axis_), cos_full_, cos_cone_) * candela(-to_light);
    if (!(share > 0))
        return std::nullopt;
    return LightRay{to_light, distance, intensity_ * share / distance2, kOnlyDirection};
}

} // namespace tsuya

#include "light_bounds.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

// Cosine of max(0, a - b), of angles up to pi, by their sines and cosines.
float cos_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 1.0f : cos_a * cos_b + sin_a * sin_b;
}
float sin_of_difference(float sin_a, float cos_a, float sin_b, float cos_b) {
    return cos_a > cos_b ? 0.0f : sin_a * cos_b - cos_a * sin_b;
}
float sine_of(float cosine) { return std::sqrt(std::max(0.0f, 1 - cosine * cosine)); }

} // namespace

LightBounds::LightBounds(const glm::vec3 &low, const glm::vec3 &high, const LightCone &cone,
                         float power)
    : low_(low), high_(high), axis_(cone.axis), middle_(0.5f * (low + high)),
      radius2_(0.25f * glm::dot(high - low, high - low)), cos_spread_(cone.cos_spread),
      sin_spread_(sine_of(cone.cos_spread)), cos_reach_(cone.cos_reach), power_(power) {}

// [Conty] Eq. 3, with the bounding sphere of the box.
float LightBounds::importance(const Receiver &receiver) const {
    const glm::vec3 offset = middle_ - receiver.position;
    const float distance2 = glm::dot(offset, offset);
    if (distance2 <= radius2_)
        return radius2_ > 0 ? power_ / radius2_ : 0;
    const float per_distance2 = 1 / distance2;
    const glm::vec3 to_light = offset * std::sqrt(per_distance2);
    const float sin2_seen = radius2_ * per_distance2;
    const float sin_seen = std::sqrt(sin2_seen), cos_seen = std::sqrt(1 - sin2_seen);

    // The least angle between where they shine and the point
    const float cos_axis = -glm::dot(axis_, to_light), sin_axis = sine_of(cos_axis);
    const float cos_outside = cos_of_difference(sin_axis, cos_axis, sin_spread_, cos_spread_);
    const float sin_outside = sin_of_difference(sin_axis, cos_axis, sin_spread_, cos_spread_);
    const float cos_emitted = cos_of_difference(sin_outside, cos_outside, sin_seen, cos_seen);
    if (!(cos_emitted > cos_reach_))
        return 0;

    float cos_received = glm::dot(receiver.normal, to_light);
    if (receiver.both_sides)
        cos_received = std::abs(cos_received);
    cos_received = cos_of_difference(sine_of(cos_received), cos_received, sin_seen, cos_seen);
    return power_ * cos_emitted * std::max(0.0f, cos_received) * per_distance2;
}

} // namespace tsuya

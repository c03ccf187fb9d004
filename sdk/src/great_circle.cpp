#include "tsuya/sdk/great_circle.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kHalfPi = 0.5f * kPi; // `a` of [Takeda] Eq. 15
// Below these the limits of the quotients are exact to float.
constexpr float kSmallSine = 1e-6f;
constexpr float kSmallTilt = 1e-3f;

// The light as the map sees it: its tilt from the normal and the axis R away from it.
struct Axis {
    glm::vec3 away{1, 0, 0};
    float tilt = 0;
};

Axis axis_of(const glm::vec3 &to_light) {
    const float horizontal = std::sqrt(to_light.x * to_light.x + to_light.y * to_light.y);
    if (!(horizontal > 0))
        return {};
    return {{-to_light.x / horizontal, -to_light.y / horizontal, 0},
            std::min(std::atan2(horizontal, to_light.z), kHalfPi)};
}

// a/(a - theta_i) towards R, a/(a + theta_i) on the light's side
float slope_towards(float tilt) { return kHalfPi / std::max(kHalfPi - tilt, 1e-7f); }
float slope_behind(float tilt) { return kHalfPi / (kHalfPi + tilt); }

} // namespace

GreatCircle to_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    const Axis axis = axis_of(to_light);
    GreatCircle c;
    const float cosine = glm::dot(axis.away, to_viewer);
    const glm::vec3 across = to_viewer - cosine * axis.away;
    const float sine = glm::length(across);
    c.beta = std::atan2(sine, cosine);
    // [Takeda] Eq. 15
    if (c.beta <= kHalfPi - axis.tilt) {
        c.slope = slope_towards(axis.tilt);
        c.beta0 = std::min(c.slope * c.beta, kHalfPi);
    } else {
        c.slope = slope_behind(axis.tilt);
        // = slope * beta + pi theta_i/(a + theta_i), exact at beta = pi
        c.beta0 = kPi - c.slope * (kPi - c.beta);
    }
    c.sine_ratio = sine > kSmallSine ? std::sin(c.beta0) / sine : c.slope;
    c.basic = std::cos(c.beta0) * axis.away + c.sine_ratio * across;
    c.basic.z = std::max(c.basic.z, 0.0f);
    return c;
}

ViewOfBasic view_of_basic(const glm::vec3 &to_light, const glm::vec3 &basic) {
    const Axis axis = axis_of(to_light);
    ViewOfBasic v;
    const float cosine = glm::dot(axis.away, basic);
    const glm::vec3 across = basic - cosine * axis.away;
    const float sine = glm::length(across);
    const float beta0 = std::atan2(sine, cosine);
    v.slope = beta0 <= kHalfPi ? slope_towards(axis.tilt) : slope_behind(axis.tilt);
    const float beta = beta0 <= kHalfPi ? beta0 / v.slope : kPi - (kPi - beta0) / v.slope;
    const float ratio = sine > kSmallSine ? std::sin(beta) / sine : 1 / v.slope;
    v.sine_ratio = 1 / std::max(ratio, 1e-12f);
    v.to_viewer = std::cos(beta) * axis.away + ratio * across;
    return v;
}

std::optional<glm::vec3> light_of_basic(const glm::vec3 &to_viewer, const glm::vec3 &basic) {
    const glm::vec2 r = glm::vec2(to_viewer) * basic.z - glm::vec2(basic) * to_viewer.z;
    const float length = glm::length(r);
    if (length < 1e-9f)
        return glm::vec3(0, 0, 1);
    const glm::vec3 away(r / length, 0);
    const auto angle = [&](const glm::vec3 &d) {
        const float cosine = glm::dot(away, d);
        return std::atan2(glm::length(d - cosine * away), cosine);
    };
    const float beta = angle(to_viewer), beta0 = angle(basic);
    const float tilt = beta0 <= kHalfPi ? kHalfPi * (1 - beta / std::max(beta0, 1e-12f))
                                        : kHalfPi * (beta0 - beta) / std::max(kPi - beta0, 1e-12f);
    if (!(tilt >= 0 && tilt < kHalfPi))
        return std::nullopt;
    const glm::vec3 to_light = -std::sin(tilt) * away + glm::vec3(0, 0, std::cos(tilt));
    return to_light.z > 0 ? std::optional(to_light) : std::nullopt;
}

float jacobian_of_light(const GreatCircle &c, const glm::vec3 &to_light,
                        const glm::vec3 &to_viewer) {
    const float horizontal = std::sqrt(to_light.x * to_light.x + to_light.y * to_light.y);
    const float tilt = std::atan2(horizontal, to_light.z);
    const bool towards = c.beta <= kHalfPi - tilt;
    const float turn =
        towards ? c.beta0 / std::max(kHalfPi - tilt, 1e-7f) : (kPi - c.beta0) / (kHalfPi + tilt);
    // (beta0 - beta)/theta_i, which stays finite for light from straight above
    const float rate =
        towards ? c.beta / std::max(kHalfPi - tilt, 1e-7f) : (kPi - c.beta) / (kHalfPi + tilt);
    const float sines = tilt > kSmallTilt ? std::sin(rate * tilt) / horizontal : rate;
    const float sine = std::sin(c.beta);
    if (!(sine > kSmallSine))
        return 0;
    return turn * sines * to_viewer.z / (sine * sine);
}

} // namespace tsuya

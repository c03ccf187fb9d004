#include "tsuya/sdk/great_circle.h"

#include <algorithm>
#include <cmath>

#include "fast_trig.h"

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
            std::min(angle_of(horizontal, to_light.z), kHalfPi)};
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
    c.beta = angle_of(sine, cosine);
    c.sine = sine;
    c.tilt = axis.tilt;
    // [Takeda] Eq. 15
    if (c.beta <= kHalfPi - axis.tilt) {
        c.slope = slope_towards(axis.tilt);
        c.beta0 = std::min(c.slope * c.beta, kHalfPi);
    } else {
        c.slope = slope_behind(axis.tilt);
        // = slope * beta + pi theta_i/(a + theta_i), exact at beta = pi
        c.beta0 = kPi - c.slope * (kPi - c.beta);
    }
    const SineCosine turned = sine_cosine(c.beta0);
    c.sine_ratio = sine > kSmallSine ? turned.sine / sine : c.slope;
    c.basic = turned.cosine * axis.away + c.sine_ratio * across;
    c.basic.z = std::max(c.basic.z, 0.0f);
    return c;
}

ViewOfBasic view_of_basic(const glm::vec3 &to_light, const glm::vec3 &basic) {
    const Axis axis = axis_of(to_light);
    ViewOfBasic v;
    const float cosine = glm::dot(axis.away, basic);
    const glm::vec3 across = basic - cosine * axis.away;
    const float sine = glm::length(across);
    const float beta0 = angle_of(sine, cosine);
    v.slope = beta0 <= kHalfPi ? slope_towards(axis.tilt) : slope_behind(axis.tilt);
    const float beta = beta0 <= kHalfPi ? beta0 / v.slope : kPi - (kPi - beta0) / v.slope;
    const SineCosine turned = sine_cosine(beta);
    const float ratio = sine > kSmallSine ? turned.sine / sine : 1 / v.slope;
    v.sine_ratio = 1 / std::max(ratio, 1e-12f);
    v.to_viewer = turned.cosine * axis.away + ratio * across;
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
        return angle_of(glm::length(d - cosine * away), cosine);
    };
    const float beta = angle(to_viewer), beta0 = angle(basic);
    const float tilt = beta0 <= kHalfPi ? kHalfPi * (1 - beta / std::max(beta0, 1e-12f))
                                        : kHalfPi * (beta0 - beta) / std::max(kPi - beta0, 1e-12f);
    if (!(tilt >= 0 && tilt < kHalfPi))
        return std::nullopt;
    const SineCosine tilted = sine_cosine(tilt);
    const glm::vec3 to_light = -tilted.sine * away + glm::vec3(0, 0, tilted.cosine);
    return to_light.z > 0 ? std::optional(to_light) : std::nullopt;
}

float jacobian_of_light(const GreatCircle &c, const glm::vec3 &to_light,
                        const glm::vec3 &to_viewer) {
    if (!(c.sine > kSmallSine))
        return 0;
    const bool towards = c.beta <= kHalfPi - c.tilt;
    const float span = towards ? std::max(kHalfPi - c.tilt, 1e-7f) : kHalfPi + c.tilt;
    const float turn = (towards ? c.beta0 : kPi - c.beta0) / span; // dbeta0/dtheta_i
    // (beta0 - beta)/theta_i, which stays finite for light from straight above
    const float rate = (towards ? c.beta : kPi - c.beta) / span;
    const float horizontal = std::sqrt(to_light.x * to_light.x + to_light.y * to_light.y);
    const float sines = c.tilt > kSmallTilt ? sine_cosine(rate * c.tilt).sine / horizontal : rate;
    return turn * sines * to_viewer.z / (c.sine * c.sine);
}

} // namespace tsuya

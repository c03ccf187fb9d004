#include "tsuya/sdk/detail/great_circle.h"

#include <algorithm>
#include <cmath>

#include "tables/fast_trig.h"
#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

// Below it the limit of the quotient is exact to float.
constexpr float kSmallSine = 1e-6f;

// The light as the map sees it: its tilt from the normal and the axis R away from it.
struct Axis {
    glm::vec3 away{1, 0, 0};
    float tilt = 0;
    float rest = kHalfPiF; // from the horizon: a - tilt, precise at grazing

    // What is left of a direction without its part along R. From its own part across R: the
    // difference of two vectors would lose a small rest, and V0 its length with it.
    glm::vec3 across(const glm::vec3 &d) const {
        const float side = away.x * d.y - away.y * d.x;
        return {-away.y * side, away.x * side, d.z};
    }
};

Axis axis_of(const glm::vec3 &to_light) {
    const float horizontal = std::sqrt(to_light.x * to_light.x + to_light.y * to_light.y);
    if (!(horizontal > 0))
        return {};
    return {{-to_light.x / horizontal, -to_light.y / horizontal, 0},
            std::min(angle_of(horizontal, to_light.z), kHalfPiF),
            std::max(angle_of(to_light.z, horizontal), 1e-7f)};
}

// a/(a - theta_i) towards R, a/(a + theta_i) on the light's side
float slope_towards(const Axis &axis) { return kHalfPiF / axis.rest; }
float slope_behind(const Axis &axis) { return kHalfPiF / (kHalfPiF + axis.tilt); }

} // namespace

GreatCircle to_basic(const glm::vec3 &to_light, const glm::vec3 &to_viewer) {
    const Axis axis = axis_of(to_light);
    GreatCircle c;
    const float cosine = glm::dot(axis.away, to_viewer);
    const glm::vec3 across = axis.across(to_viewer);
    const float sine = glm::length(across);
    c.beta = angle_of(sine, cosine);
    // [Takeda] Eq. 15
    if (c.beta <= axis.rest) {
        c.slope = slope_towards(axis);
        c.beta0 = std::min(c.slope * c.beta, kHalfPiF);
    } else {
        c.slope = slope_behind(axis);
        // = slope * beta + pi theta_i/(a + theta_i), exact at beta = pi
        c.beta0 = kPiF - c.slope * (kPiF - c.beta);
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
    const glm::vec3 across = axis.across(basic);
    const float sine = glm::length(across);
    const float beta0 = angle_of(sine, cosine);
    v.slope = beta0 <= kHalfPiF ? slope_towards(axis) : slope_behind(axis);
    const float beta = beta0 <= kHalfPiF ? beta0 / v.slope : kPiF - (kPiF - beta0) / v.slope;
    const SineCosine turned = sine_cosine(beta);
    const float ratio = sine > kSmallSine ? turned.sine / sine : 1 / v.slope;
    v.sine_ratio = 1 / std::max(ratio, 1e-12f);
    v.to_viewer = turned.cosine * axis.away + ratio * across;
    return v;
}

} // namespace tsuya

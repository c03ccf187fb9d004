#include "light_rectangle.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

// The area of a light over the square of its distance: where it is smaller, sampling the area is as
// good and takes less time.
constexpr float kLeastAreaSeen = 0.05f;
// Steradians below which float numbers do not have the place that is sampled.
constexpr float kLeastSolidAngle = 1e-3f;
// Cosine between sides that are not at right angles.
constexpr double kRightAngle = 1e-6;

} // namespace

LightRectangle::LightRectangle(const RectangleLight &light, const glm::dvec3 &centre)
    : corner_(light.corner - centre), edge_u_(light.edge_u), edge_v_(light.edge_v),
      radiance_(static_cast<float>(light.radiance)) {
    const glm::dvec3 across = glm::cross(light.edge_u, light.edge_v);
    const double width = glm::length(light.edge_u), height = glm::length(light.edge_v);
    normal_ = glm::normalize(across);
    dual_u_ = glm::cross(light.edge_v, across) / glm::dot(across, across);
    dual_v_ = glm::cross(across, light.edge_u) / glm::dot(across, across);
    side_x_ = light.edge_u / width;
    side_y_ = light.edge_v / height;
    width_ = static_cast<float>(width);
    height_ = static_cast<float>(height);
    area_ = static_cast<float>(glm::length(across));
    right_angled_ = std::abs(glm::dot(light.edge_u, light.edge_v)) < kRightAngle * width * height;
}

LightBounds LightRectangle::bounds(float power) const {
    glm::vec3 low = corner_, high = corner_;
    for (const glm::vec3 &corner :
         {corner_ + edge_u_, corner_ + edge_v_, corner_ + edge_u_ + edge_v_}) {
        low = glm::min(low, corner);
        high = glm::max(high, corner);
    }
    return {low, high, {.axis = normal_}, power};
}

LightRectangle::Seen LightRectangle::seen(const glm::vec3 &from) const {
    const glm::vec3 offset = corner_ - from;
    const float x = glm::dot(offset, side_x_), y = glm::dot(offset, side_y_);
    return {x, x + width_, y, y + height_, -glm::dot(offset, normal_)};
}

// [Oosterom] of two triangles: exact for small angles too, where sums of the corners' angles
// cancel.
float LightRectangle::sampled_angle(const Seen &s) const {
    const float x = 0.5f * (s.x0 + s.x1), y = 0.5f * (s.y0 + s.y1);
    if (!(right_angled_ && area_ > kLeastAreaSeen * (x * x + y * y + s.height * s.height)))
        return 0;
    const glm::vec3 a(s.x0, s.y0, s.height), b(s.x1, s.y0, s.height), c(s.x1, s.y1, s.height),
        d(s.x0, s.y1, s.height);
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c), ld = glm::length(d);
    const float volume = s.height * width_ * height_, diagonal = glm::dot(a, c) + la * lc;
    const float angle =
        2 * (std::atan2(volume, diagonal * lb + glm::dot(a, b) * lc + glm::dot(b, c) * la) +
             std::atan2(volume, diagonal * ld + glm::dot(a, d) * lc + glm::dot(d, c) * la));
    return angle > kLeastSolidAngle ? angle : 0.0f;
}

// [Urena] with the normals of the four sides' planes written out. Their corners' angles give the
// first coordinate, the height of the band of that coordinate on the sphere gives the second.
glm::vec2 LightRectangle::sample_angle(const Seen &s, float solid_angle, glm::vec2 u) {
    const float h2 = s.height * s.height;
    const auto tilt = [&](float at) { return at / std::sqrt(at * at + h2); };
    const float low_y = -tilt(s.y0), high_y = tilt(s.y1), low_x = -tilt(s.x0);
    const float k = 2 * kPiF - std::acos(-high_y * low_x) - std::acos(-low_x * low_y);
    const float angle = u.x * solid_angle + k;
    const float f = (std::cos(angle) * low_y - high_y) / std::sin(angle);
    const float x = std::clamp(
        std::copysign(s.height / std::sqrt(std::max(f * f + low_y * low_y - 1, 0.0f)), f), s.x0,
        s.x1);
    const float d2 = x * x + h2;
    const auto sine = [&](float y) { return y / std::sqrt(d2 + y * y); };
    const float at = glm::mix(sine(s.y0), sine(s.y1), u.y);
    const float y = std::clamp(at * std::sqrt(d2 / std::max(1 - at * at, 0.0f)), s.y0, s.y1);
    return {x, y};
}

std::optional<LightRay> LightRectangle::sample(const glm::vec3 &from, glm::vec2 u) const {
    const Seen s = seen(from);
    if (!(s.height > 0))
        return std::nullopt;
    const float angle = sampled_angle(s);
    const glm::vec2 at = angle > 0 ? sample_angle(s, angle, u) - glm::vec2(s.x0, s.y0)
                                   : u * glm::vec2(width_, height_);
    const glm::vec3 offset = (corner_ - from) + at.x * side_x_ + at.y * side_y_;
    const float distance = glm::length(offset);
    const glm::vec3 to_light = offset / distance;
    return LightRay{to_light, distance, radiance_,
                    angle > 0 ? 1 / angle : distance * distance * distance / (s.height * area_)};
}

float LightRectangle::pdf(const glm::vec3 &from, const glm::vec3 &direction, float distance) const {
    const float angle = sampled_angle(seen(from));
    return angle > 0 ? 1 / angle : distance * distance / (-glm::dot(direction, normal_) * area_);
}

} // namespace tsuya

#include "light_disk.h"

#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {

LightDisk::LightDisk(const DiskLight &light, const glm::dvec3 &centre)
    : centre_(light.centre - centre),
      frame_(make_frame(glm::vec3(glm::normalize(light.direction)))),
      radius_(static_cast<float>(light.radius)), radiance_(static_cast<float>(light.radiance)) {}

double LightDisk::highest_intensity() const {
    return kPi * static_cast<double>(radiance_) * static_cast<double>(radius_) *
           static_cast<double>(radius_);
}

LightBounds LightDisk::bounds(float power) const {
    const glm::vec3 size =
        radius_ * glm::sqrt(glm::max(1.0f - frame_.normal * frame_.normal, 0.0f));
    return {centre_ - size, centre_ + size, {.axis = frame_.normal}, power};
}

std::optional<LightRay> LightDisk::sample(const glm::vec3 &from, glm::vec2 u) const {
    const glm::vec3 to_centre = centre_ - from;
    const float height = -glm::dot(to_centre, frame_.normal);
    if (!(height > 0))
        return std::nullopt;
    const float r = radius_ * std::sqrt(u.x), phi = 2 * kPiF * u.y;
    const glm::vec3 offset =
        to_centre + r * (std::cos(phi) * frame_.weft + std::sin(phi) * frame_.warp);
    const float distance = glm::length(offset);
    return LightRay{offset / distance, distance, radiance_,
                    distance * distance * distance / (height * kPiF * radius_ * radius_)};
}

std::optional<float> LightDisk::obstacle(const glm::vec3 &from, const glm::vec3 &direction) const {
    const glm::vec3 to_centre = centre_ - from;
    const float t = glm::dot(to_centre, frame_.normal) / glm::dot(direction, frame_.normal);
    if (!(t > 0))
        return std::nullopt;
    const glm::vec3 p = t * direction - to_centre;
    return glm::dot(p, p) <= radius_ * radius_ ? std::optional(t) : std::nullopt;
}

std::optional<float> LightDisk::crossing(const glm::vec3 &from, const glm::vec3 &direction) const {
    return glm::dot(direction, frame_.normal) < 0 ? obstacle(from, direction) : std::nullopt;
}

float LightDisk::pdf(const glm::vec3 &, const glm::vec3 &direction, float distance) const {
    return distance * distance / (-glm::dot(direction, frame_.normal) * kPiF * radius_ * radius_);
}

} // namespace tsuya

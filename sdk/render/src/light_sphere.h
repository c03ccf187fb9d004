#pragma once
// A sphere that shines, in the scene's centred space.

#include <optional>

#include <glm/glm.hpp>

#include "light_bounds.h"
#include "light_ray.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

// Sampled evenly over its solid angle. Nothing inside of it receives its light. The operations are
// those of LightRectangle.
class LightSphere {
  public:
    LightSphere(const SphereLight &light, const glm::dvec3 &centre);

    float radiance() const { return radiance_; }
    double highest_intensity() const;
    LightBounds bounds(float power) const;
    std::optional<LightRay> sample(const glm::vec3 &from, glm::vec2 u) const;
    std::optional<float> crossing(const glm::vec3 &from, const glm::vec3 &direction) const;
    // Where a ray from inside leaves it is no obstacle.
    std::optional<float> obstacle(const glm::vec3 &from, const glm::vec3 &direction) const {
        return crossing(from, direction);
    }
    float pdf(const glm::vec3 &from, const glm::vec3 &direction, float distance) const;

  private:
    glm::vec3 centre_;
    float radius_, radiance_;
};

} // namespace tsuya

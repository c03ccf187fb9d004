#pragma once
// A disk that shines, in the scene's centred space.

#include <optional>

#include <glm/glm.hpp>

#include "light_bounds.h"
#include "light_ray.h"
#include "tsuya/sdk/frame.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

// Sampled evenly over its area. The operations are those of LightRectangle.
class LightDisk {
  public:
    LightDisk(const DiskLight &light, const glm::dvec3 &centre);

    float radiance() const { return radiance_; }
    double highest_intensity() const;
    LightBounds bounds(float power) const;
    std::optional<LightRay> sample(const glm::vec3 &from, glm::vec2 u) const;
    std::optional<float> crossing(const glm::vec3 &from, const glm::vec3 &direction) const;
    std::optional<float> obstacle(const glm::vec3 &from, const glm::vec3 &direction) const;
    float pdf(const glm::vec3 &from, const glm::vec3 &direction, float distance) const;

  private:
    glm::vec3 centre_;
    Frame frame_; // of the side that shines
    float radius_, radiance_;
};

} // namespace tsuya

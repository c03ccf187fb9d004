#pragma once
// A light at a point, in the scene's centred space.

#include <optional>

#include <glm/glm.hpp>

#include "light_bounds.h"
#include "light_ray.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

// No ray meets it. The operations are those of LightRectangle.
class LightPoint {
  public:
    LightPoint(const PointLight &light, const glm::dvec3 &centre);

    double highest_intensity() const {
        return static_cast<double>(intensity_) * (profile_ ? profile_->highest() : 1);
    }
    LightBounds bounds(float power) const;
    std::optional<LightRay> sample(const glm::vec3 &from, glm::vec2 u) const;
    static std::optional<float> crossing(const glm::vec3 &, const glm::vec3 &) { return {}; }
    static std::optional<float> obstacle(const glm::vec3 &, const glm::vec3 &) { return {}; }
    static float radiance() { return 0; }
    static float pdf(const glm::vec3 &, const glm::vec3 &, float) { return 0; }

  private:
    float candela(const glm::vec3 &away) const;

    glm::vec3 position_, axis_;
    float intensity_, cos_full_, cos_cone_;
    const IntensityProfile *profile_ = nullptr; // of the scene
    glm::vec3 zero_{0}, quarter_{0};            // of its horizontal angles
};

} // namespace tsuya

#pragma once
// Light from a disc of the sky, or from one direction.

#include <optional>

#include <glm/glm.hpp>

#include "light_ray.h"
#include "tsuya/sdk/light.h"

namespace tsuya {

class LightSun {
  public:
    explicit LightSun(const SunLight &light);

    LightRay sample(glm::vec2 u) const;
    // A ray of this direction meets it.
    bool is_met(const glm::vec3 &direction) const {
        const glm::vec3 apart = direction - axis_; // exact for small angles too
        return glm::dot(apart, apart) <= 2 * wide_ && wide_ > 0;
    }
    // Of what meets it.
    float radiance() const { return radiance_; }
    float pdf() const { return pdf_; } // 1/sr
    double irradiance() const { return irradiance_; }

  private:
    glm::vec3 axis_;
    float wide_ = 0; // 1 - cosine of the angular radius; 0: parallel
    float radiance_, pdf_ = kOnlyDirection;
    double irradiance_;
};

} // namespace tsuya

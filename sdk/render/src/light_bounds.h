#pragma once
// Where lights are, and where they shine to: by which one of many is chosen.

#include <glm/glm.hpp>

namespace tsuya {

// A point that receives light.
struct Receiver {
    glm::vec3 position, normal;
    bool both_sides; // light from behind counts too
};

// Angles about an axis to which lights shine.
struct LightCone {
    glm::vec3 axis{0, 0, 1};
    // Cosine of the half angle of the directions that lights face.
    float cos_spread = 1;
    // Cosine of how far to the side of that they shine: 0 for a surface, up to a right angle.
    float cos_reach = 0;
};

// Where some lights are, and where they shine to.
class LightBounds {
  public:
    LightBounds() = default;
    // \param power of all lights, in proportion: the intensity of each where it is highest
    LightBounds(const glm::vec3 &low, const glm::vec3 &high, const LightCone &cone, float power);

    const glm::vec3 &low() const { return low_; }
    const glm::vec3 &high() const { return high_; }
    const glm::vec3 &axis() const { return axis_; }
    float cos_spread() const { return cos_spread_; }
    float cos_reach() const { return cos_reach_; }
    float power() const { return power_; }
    // What they may give to a point at most, but for a factor that all lights share: 0 where they
    // certainly give nothing.
    float importance(const Receiver &receiver) const;

  private:
    glm::vec3 low_{}, high_{}, axis_{};
    glm::vec3 middle_{}; // of the box, and of the sphere around it
    float radius2_ = 0, cos_spread_ = 1, sin_spread_ = 0, cos_reach_ = 0, power_ = 0;
};

} // namespace tsuya

#pragma once
// What sampling a light gives.

#include <limits>

#include <glm/glm.hpp>

namespace tsuya {

// The density of a direction that nothing but sampling its light finds.
inline constexpr float kOnlyDirection = std::numeric_limits<float>::infinity();

struct LightRay {
    glm::vec3 to_light;
    float distance; // infinite for suns and the environment
    float radiance; // of kOnlyDirection: irradiance of a plane that faces the light
    float pdf;      // 1/sr, or kOnlyDirection
};

} // namespace tsuya

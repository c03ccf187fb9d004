#pragma once
// Azimuth without trigonometry, as tables over directions count it.

#include <cmath>

#include <glm/glm.hpp>

namespace tsuya {

// |x| + |y| = 1 walked from the weft axis, 1 a quarter turn, in [0, 4].
inline float quarters(const glm::vec3 &d) {
    const float sum = std::abs(d.x) + std::abs(d.y);
    if (!(sum > 0))
        return 0;
    const float t = std::abs(d.y) / sum;
    if (d.x >= 0)
        return d.y >= 0 ? t : 4 - t;
    return d.y >= 0 ? 2 - t : 2 + t;
}

// The unit horizontal direction there.
inline glm::vec2 azimuth_of(float quarter) {
    const int whole = static_cast<int>(quarter);
    const float t = quarter - static_cast<float>(whole);
    const glm::vec2 axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    return glm::normalize((1 - t) * axes[whole % 4] + t * axes[(whole + 1) % 4]);
}

} // namespace tsuya

#pragma once
/// \file
/// How much of a yarn's filaments light and viewer both reach: the masking of parallel cylinders.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// Yarns side by side, each flat on top with round flanks, covered with round filaments side by
/// side. All is seen in the plane across the yarns, where a filament reflects at the normal midway
/// between light and viewer. A filament is hidden by its neighbours, a flank by the next yarn.
/// Reciprocal and mirrored. See sdk/docs/REFLECTANCE_STUDY.md for the derivation.
class FilamentBed {
  public:
    FilamentBed() = default;
    /// \param flank share of the filaments seen from straight above that lie on the flanks, 0 to 1
    explicit FilamentBed(double flank);

    /// Share of the filaments that reach both, 0 to 1.
    /// \param light, viewer angles from the yarn's normal as `bed_angle` codes them
    float at(float light, float viewer) const;

    static constexpr int kNodes = 97; ///< of the table, about 1.9 degrees

  private:
    std::vector<float> value_{}; ///< [light][viewer], both from -1 to 1
};

/// The angle from the yarn's normal in the plane across it as a number from -1 to 1 that needs no
/// arc tangent: 0 along the normal, 1 and -1 at a right angle or beyond.
inline float bed_angle(float across, float up) {
    constexpr float kSmallest = 1e-20f;
    return across / (std::abs(across) + std::max(up, 0.0f) + kSmallest);
}

inline float FilamentBed::at(float light, float viewer) const {
    constexpr float kHalf = 0.5f * (kNodes - 1);
    // A quadratic B-spline: smooth, and never outside of what the nodes have
    const auto weights = [](float t) { // of the nodes about the nearest, t away from it
        const float below = 0.5f - t, above = 0.5f + t;
        return glm::vec3(0.5f * below * below, 0.75f - t * t, 0.5f * above * above);
    };
    const float x = (light + 1) * kHalf, y = (viewer + 1) * kHalf;
    const int i = std::clamp(static_cast<int>(x + 0.5f), 1, kNodes - 2);
    const int j = std::clamp(static_cast<int>(y + 0.5f), 1, kNodes - 2);
    const glm::vec3 wx = weights(std::clamp(x - static_cast<float>(i), -0.5f, 0.5f));
    const glm::vec3 wy = weights(std::clamp(y - static_cast<float>(j), -0.5f, 0.5f));
    const float *row = &value_[static_cast<std::size_t>((i - 1) * kNodes + j - 1)];
    float sum = 0;
    for (int k = 0; k < 3; ++k, row += kNodes)
        sum += wx[k] * (wy[0] * row[0] + wy[1] * row[1] + wy[2] * row[2]);
    return sum;
}

} // namespace tsuya

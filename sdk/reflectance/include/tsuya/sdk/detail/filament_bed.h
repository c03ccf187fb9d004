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
    const float x = (light + 1) * kHalf, y = (viewer + 1) * kHalf;
    const int i = std::clamp(static_cast<int>(x), 0, kNodes - 2);
    const int j = std::clamp(static_cast<int>(y), 0, kNodes - 2);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const float *const row = &value_[static_cast<std::size_t>(i * kNodes + j)];
    const float *const next = row + kNodes;
    return (1 - s) * ((1 - t) * row[0] + t * row[1]) + s * ((1 - t) * next[0] + t * next[1]);
}

} // namespace tsuya

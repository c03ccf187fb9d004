#pragma once
/// \file
/// How much of a yarn's filaments light and viewer both reach: the masking of parallel cylinders.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/spline.h"

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

    /// Share of the filaments of weft and warp that reach both, 0 to 1.
    /// \param angles from the yarn's normal as `bed_angle` codes them: of light and viewer about
    /// the weft, then about the warp
    glm::vec2 at(FourFloats angles) const;

    static constexpr int kNodes = 97; ///< of the table, about 1.9 degrees

  private:
    static constexpr int kLine = kNodes + 2;

    /// [light][viewer], both from -1 to 1, with a node beyond each end
    std::vector<float> value_{};
};

/// The angle from the yarn's normal in the plane across it as a number from -1 to 1 that needs no
/// arc tangent: 0 along the normal, 1 and -1 at a right angle or beyond.
inline float bed_angle(float across, float up) {
    constexpr float kSmallest = 1e-20f;
    return across / (std::abs(across) + std::max(up, 0.0f) + kSmallest);
}

inline glm::vec2 FilamentBed::at(FourFloats angles) const {
    // Of the values themselves: what is smooth so is never outside of them
    const SplinePlaces places((angles + 1.0f) * (0.5f * (kNodes - 1)), four(kNodes - 1));
    const auto line = [&](int light, int viewer) {
        return spline_between_lines(
            &value_[static_cast<std::size_t>(places.first[light] * kLine + places.first[viewer])],
            kLine, places.from[light]);
    };
    const FourFloats made = spline_along_lines(line(0, 1), line(2, 3),
                                               FourFloats{places.from[1], places.from[3], 0, 0});
    return {made[0], made[1]};
}

} // namespace tsuya

#pragma once
/// \file
/// What a yarn does to light but for the directions of its filaments: Fresnel term, masking, second
/// reflections.

#include <array>

#include <glm/glm.hpp>

#include "tsuya/sdk/filament_bed.h"

namespace tsuya {

/// The half vector of two directions, with what all yarns need of it.
struct YarnHalf {
    glm::vec3 half;       ///< unit
    float cosine;         ///< of light or viewer with it
    float fresnel;        ///< there
    glm::vec2 axial_mean; ///< mean of |x| and of |y| of the two directions
};

/// One system of yarns, at the yarn whose filaments can reflect one direction to another: its
/// normal is the half vector without the part across the yarn.
struct YarnReach {
    float value;     ///< F M and second reflections, times shadows of crossing yarns
    float to_light;  ///< 2 N.n / n.L: [Takeda] Eq. 4 has N.L times it as the light's masking
    float to_viewer; ///< the same of the viewer

    /// value G / (4 cos first cos second), times the first cosine
    float times_cosine(float first, float second) const {
        const float open = 1 / second, first_masked = to_light * first / second;
        const float least = open < first_masked ? open : first_masked;
        return 0.25f * value * (least < to_viewer ? least : to_viewer);
    }
};

/// Filaments of one refractive index in yarns along the weft (x) or the warp (y).
class YarnOptics {
  public:
    YarnOptics() = default;
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]
    explicit YarnOptics(double f0);

    YarnHalf half(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    /// \param axis 0 for weft, 1 for warp
    /// \param pit depth at which the yarns lie between crossing ones, in widths of the opening
    YarnReach reach(int axis, float pit, const YarnHalf &half, const glm::vec3 &to_light,
                    const glm::vec3 &to_viewer) const;

  private:
    static constexpr int kNodes = 257;
    FilamentBed bed_{};
    std::array<float, kNodes> fresnel_{}; ///< over the cosine
    std::array<float, kNodes> second_{};  ///< over the square of the mean part along the yarn
};

} // namespace tsuya

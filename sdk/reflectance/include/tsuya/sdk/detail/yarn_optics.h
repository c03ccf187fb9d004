#pragma once
/// \file
/// What a yarn does to light but for the directions of its filaments: Fresnel term, masking, second
/// reflections.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/filament_bed.h"

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
    /// \param open, ratio 1 / cos second and cos first / cos second
    float times_cosine(float open, float ratio) const {
        return 0.25f * value * std::min(std::min(open, to_light * ratio), to_viewer);
    }
};

/// Filaments of one refractive index in yarns along the weft (x) or the warp (y).
class YarnOptics {
  public:
    YarnOptics() = default;
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]
    explicit YarnOptics(double f0);

    YarnHalf half(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    /// \tparam kAxis 0 for yarns along the weft, 1 for the warp
    /// \param pit depth at which the yarns lie between crossing ones, in widths of the opening
    template <int kAxis>
    YarnReach reach(float pit, const YarnHalf &half, const glm::vec3 &to_light,
                    const glm::vec3 &to_viewer) const;

  private:
    static constexpr int kNodes = 257;
    // The grooves across the yarn are this much flatter than those that would mask at the half
    // vector: they bound what grazing rays see, beyond 80 degrees, and change little before
    static constexpr float kGrazingGroove = 6;
    static constexpr float kSmallest = 1e-20f;

    static float look_up(const std::array<float, kNodes> &table, float share) {
        const float x = share * (kNodes - 1);
        const int i = std::clamp(static_cast<int>(x), 0, kNodes - 2);
        const float t = x - static_cast<float>(i);
        const float *const at = &table[static_cast<std::size_t>(i)];
        return (1 - t) * at[0] + t * at[1];
    }

    FilamentBed bed_{};
    std::array<float, kNodes> fresnel_{}; ///< over the cosine
    std::array<float, kNodes> second_{};  ///< over the square of the mean part along the yarn
};

/// A yarn at the bottom of an opening between yarns that cross it: the share of the opening's width
/// that neither light nor viewer lose to its walls. Directions as (along the yarn, up).
inline float open_share(float pit, const glm::vec2 &light, const glm::vec2 &viewer) {
    constexpr float kLowest = 1e-20f;
    const float l = light.x / std::max(light.y, kLowest);
    const float v = viewer.x / std::max(viewer.y, kLowest);
    const float span = std::max(std::max(l, v), 0.0f) - std::min(std::min(l, v), 0.0f);
    return std::max(1 - pit * span, 0.0f);
}

inline YarnHalf YarnOptics::half(const glm::vec3 &l, const glm::vec3 &v) const {
    const float length = std::sqrt(std::max(2 * (1 + glm::dot(l, v)), kSmallest));
    const float cosine = std::clamp(0.5f * length, 1e-10f, 1.0f);
    return {(l + v) * (1 / length), cosine, look_up(fresnel_, cosine),
            0.5f * (glm::abs(glm::vec2(l)) + glm::abs(glm::vec2(v)))};
}

template <int kAxis>
YarnReach YarnOptics::reach(float pit, const YarnHalf &h, const glm::vec3 &l,
                            const glm::vec3 &v) const {
    constexpr int kAcross = 1 - kAxis;
    // The yarn's normal (along the yarn, up)
    const glm::vec2 part(h.half[kAxis], h.half.z);
    const glm::vec2 normal = part * (1 / std::sqrt(std::max(glm::dot(part, part), kSmallest)));
    const glm::vec2 light(l[kAxis], l.z), viewer(v[kAxis], v.z);
    const float n_l = glm::dot(light, normal), n_v = glm::dot(viewer, normal);
    const float bed = bed_.at(bed_angle(l[kAcross], n_l), bed_angle(v[kAcross], n_v));
    const float axial = h.axial_mean[kAxis];
    float value = h.fresnel * bed + look_up(second_, axial * axial);
    if (pit > 0)
        value *= open_share(pit, light, viewer);
    const float grazing = kGrazingGroove * std::max(h.half.z, 0.0f) / h.cosine;
    const float grooves = 2 * normal.y;
    return {value, std::min(grooves / std::max(n_l, kSmallest), grazing),
            std::min(grooves / std::max(n_v, kSmallest), grazing)};
}

} // namespace tsuya

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
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// |x| without its corner at 0.
inline float smooth_abs(float x) {
    constexpr float kRounded = 0.03f;
    return std::sqrt(x * x + kRounded * kRounded) - kRounded;
}

/// The width that two directions pass over on their way up from a depth of 1, each given by its
/// tangent: |light| + |viewer| on opposite sides, the longer on one side. Smooth.
inline float span_of(float light, float viewer) {
    return 0.5f * (smooth_abs(light) + smooth_abs(viewer) + smooth_abs(light - viewer));
}

/// The half vector of two directions, with what all yarns need of it.
struct YarnHalf {
    glm::vec3 half;         ///< unit
    float cosine;           ///< of light or viewer with it
    float fresnel;          ///< there, times the masking within the roughness
    glm::vec2 axial_square; ///< mean of x^2 and of y^2 of the two directions
    glm::vec2 span;         ///< span_of along the weft and along the warp
};

/// One system of yarns, at the yarn whose filaments can reflect one direction to another: its
/// normal is the half vector without the part across the yarn.
struct YarnReach {
    float value;     ///< F M and second reflections, times shadows of crossing yarns
    float to_light;  ///< 2 N.n / n.L: [Takeda] Eq. 4 has N.L times it as the light's masking
    float to_viewer; ///< the same of the viewer

    /// value G / (4 cos first cos second), times the first cosine. G is the least of 1 and the two
    /// maskings but for a rounded corner.
    /// \param open, ratio 1 / cos second and cos first / cos second
    float times_cosine(float open, float ratio) const {
        return 0.25f * value * rounded_least(open, to_light * ratio, to_viewer);
    }

  private:
    /// (a^-8 + b^-8 + c^-8)^(-1/8)
    static float rounded_least(float a, float b, float c) {
        const float least = std::min(std::min(a, b), c);
        const auto eighth = [&](float x) {
            const float r = least / x, r2 = r * r, r4 = r2 * r2;
            return r4 * r4;
        };
        const float sum = eighth(a) + eighth(b) + eighth(c);
        return least / std::sqrt(std::sqrt(std::sqrt(sum)));
    }
};

/// Filaments of one refractive index in yarns along the weft (x) or the warp (y).
class YarnOptics {
  public:
    YarnOptics() = default;
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]
    /// \param roughness standard deviation of a filament's surface slope
    YarnOptics(double f0, double roughness);

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

    const FilamentBed *bed_ = nullptr;    ///< of all cloths alike
    std::array<float, kNodes> fresnel_{}; ///< with the masking, over the cosine
    std::array<float, kNodes> second_{};  ///< over the mean square of the part along the yarn
};

/// A yarn at the bottom of an opening between yarns that cross it: the share of the opening's width
/// that neither light nor viewer lose to its walls, 1 - pit * span but for a rounded corner at 0.
inline float open_share(float pit, float span) {
    constexpr float kRounded = 0.05f;
    const float left = 1 - pit * span;
    const float all = 0.5f * (1 + std::sqrt(1 + kRounded * kRounded));
    return 0.5f * (left + std::sqrt(left * left + kRounded * kRounded)) / all;
}

/// The mean depth below its neighbours of the filaments that have a normal, of one system.
class YarnDive {
  public:
    YarnDive() = default;
    YarnDive(const YarnLobes &lobes, std::size_t axis);

    /// What the neighbours leave of that part for light and viewer: it lies like in an opening of
    /// the width of a yarn.
    /// \param along, up of a half vector
    /// \param span of light and viewer across the yarn
    float in_sight(float along, float up, float span) const {
        return all_ > 0 ? 1 / (1 + depth(along, up) * span) : 1;
    }

  private:
    static constexpr int kNodes = 65;
    float depth(float along, float up) const;

    float all_ = 0;
    std::array<float, kNodes> depth_{}; ///< over the angle as bed_angle codes it, one a side
};

inline float YarnDive::depth(float along, float up) const {
    // A quadratic B-spline: smooth, and rising as its nodes do
    const float x = std::abs(bed_angle(along, up)) * (kNodes - 2);
    const int i = std::clamp(static_cast<int>(x + 0.5f), 1, kNodes - 2);
    const float t = x - static_cast<float>(i);
    const float *const at = &depth_[static_cast<std::size_t>(i - 1)];
    if (x < 0.5f) // about level the spline is even
        return 0.5f * (at[0] + at[1]) + (at[1] - at[0]) * (x * x - 0.25f);
    return 0.5f * (0.5f - t) * (0.5f - t) * at[0] + (0.75f - t * t) * at[1] +
           0.5f * (0.5f + t) * (0.5f + t) * at[2];
}

inline YarnHalf YarnOptics::half(const glm::vec3 &l, const glm::vec3 &v) const {
    const float length = std::sqrt(std::max(2 * (1 + glm::dot(l, v)), kSmallest));
    const float cosine = std::clamp(0.5f * length, 1e-10f, 1.0f);
    const glm::vec2 light(l), viewer(v);
    const glm::vec2 tan_light = light * (1 / std::max(l.z, kSmallest));
    const glm::vec2 tan_viewer = viewer * (1 / std::max(v.z, kSmallest));
    return {(l + v) * (1 / length),
            cosine,
            look_up(fresnel_, cosine),
            0.5f * (light * light + viewer * viewer),
            {span_of(tan_light.x, tan_viewer.x), span_of(tan_light.y, tan_viewer.y)}};
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
    const float bed = bed_->at(bed_angle(l[kAcross], n_l), bed_angle(v[kAcross], n_v));
    float value = h.fresnel * bed + look_up(second_, h.axial_square[kAxis]);
    if (pit > 0)
        value *= open_share(pit, h.span[kAxis]);
    const float grazing = kGrazingGroove * std::max(h.half.z, 0.0f) / h.cosine;
    const float grooves = 2 * normal.y;
    return {value, std::min(grooves / std::max(n_l, kSmallest), grazing),
            std::min(grooves / std::max(n_v, kSmallest), grazing)};
}

} // namespace tsuya

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
#include "tsuya/sdk/detail/four_floats.h"

namespace tsuya {

/// The half vector of two directions, with what all yarns need of it.
struct YarnHalf {
    glm::vec3 sum;  ///< of the two directions, which keeps what is small in both
    glm::vec3 half; ///< unit
    float square;   ///< of the length of the sum
    float cosine;   ///< of light or viewer with the half vector
    float fresnel;  ///< there, times the masking within the roughness
};

/// Filaments of one refractive index in yarns along the weft (x) or the warp (y).
class YarnOptics {
  public:
    YarnOptics() = default;
    /// \param f0 reflectance of the fibre at normal incidence, in (0, 1]
    /// \param roughness standard deviation of a filament's surface slope
    YarnOptics(double f0, double roughness);

    YarnHalf half(const glm::vec3 &to_light, const glm::vec3 &to_viewer) const;
    /// Of weft and warp, (F M + second reflections) G / (4 cos_i cos_r) times the light's cosine,
    /// at the yarns whose filaments can reflect one direction to another: their normal is the half
    /// vector without the part across the yarn.
    glm::vec2 reach(const YarnHalf &half, const glm::vec3 &to_light,
                    const glm::vec3 &to_viewer) const;

  private:
    static constexpr int kNodes = 257;
    static constexpr float kSmallest = 1e-20f;

    static float look_up(const std::array<float, kNodes> &table, float share) {
        const float x = share * (kNodes - 1);
        const int i = std::clamp(static_cast<int>(x), 0, kNodes - 2);
        const float t = x - static_cast<float>(i);
        const float *const at = &table[static_cast<std::size_t>(i)];
        return (1 - t) * at[0] + t * at[1];
    }

    /// x^(-1/8) for 1 to 3, relative error 6e-6
    static FourFloats over_eighth_root(FourFloats x) {
        const FourFloats t = x - 2.0f, t2 = t * t;
        const FourFloats low =
            (0.917003043f - 0.0573416708f * t) + (0.0161502283f - 0.0054880276f * t) * t2;
        return low + (0.00208273839f - 0.00132281944f * t + 0.000605635732f * t2) * (t2 * t2);
    }

    const FilamentBed *bed_ = nullptr;    ///< of all cloths alike
    std::array<float, kNodes> fresnel_{}; ///< with the masking, over the cosine
    std::array<float, kNodes> second_{};  ///< over the mean square of the part along the yarn
};

inline YarnHalf YarnOptics::half(const glm::vec3 &l, const glm::vec3 &v) const {
    const glm::vec3 sum = l + v;
    const float square = std::max(glm::dot(sum, sum), kSmallest), length = std::sqrt(square);
    const float cosine = std::min(0.5f * length, 1.0f);
    return {sum, sum * (1 / length), square, cosine, look_up(fresnel_, cosine)};
}

// With S = L + V and S' its part in the plane along the yarn, L.S' and V.S' are the cosines with
// the yarn's normal times |S'|. [Takeda] Eq. 4 has min(1, 2 S'.z cos_i / L.S', 2 S'.z cos_r / V.S')
// for G: G / (cos_i cos_r) is 2 S'.z over the largest of 2 S'.z cos_i cos_r, cos_r L.S', cos_i
// V.S'.
inline glm::vec2 YarnOptics::reach(const YarnHalf &h, const glm::vec3 &l,
                                   const glm::vec3 &v) const {
    // The grooves across the yarn are this much flatter than those that would mask at the half
    // vector: they bound what grazing rays see, beyond 80 degrees, and change little before
    constexpr float kGrazingGroove = 6;
    constexpr float kLowest = 1e-10f; // cosine that stands for those below
    const float light_up = std::max(l.z, kLowest), viewer_up = std::max(v.z, kLowest);
    const float height = light_up + viewer_up;
    const FourFloats along{l.x, v.x, l.y, v.y}, across{l.y, v.y, l.x, v.x};
    const FourFloats up{light_up, viewer_up, light_up, viewer_up};
    const FourFloats sum{h.sum.x, h.sum.x, h.sum.y, h.sum.y};
    const FourFloats facing = largest(along * sum + up * height, four(0));
    const FourFloats turned = across * root_of(sum * sum + height * height);
    const glm::vec2 bed = bed_->at(turned / (size_of(turned) + facing + kSmallest));
    const glm::vec2 light(l), viewer(v), axial = 0.5f * (light * light + viewer * viewer);
    const glm::vec2 value(h.fresnel * bed.x + look_up(second_, axial.x),
                          h.fresnel * bed.y + look_up(second_, axial.y));

    // The largest of them but for rounded corners, (a^8 + b^8 + c^8)^(1/8)
    const FourFloats masked = FourFloats{viewer_up, light_up, viewer_up, light_up} *
                              largest(facing, four(h.square / kGrazingGroove));
    const FourFloats swapped{masked[1], masked[0], masked[3], masked[2]};
    const float open = 2 * height * light_up * viewer_up;
    const FourFloats most = largest(largest(masked, swapped), four(open)), over = 1.0f / most;
    const auto eighth = [](FourFloats x) {
        const FourFloats x2 = x * x, x4 = x2 * x2;
        return x4 * x4;
    };
    const FourFloats over_all =
        over *
        over_eighth_root(eighth(masked * over) + eighth(swapped * over) + eighth(open * over));
    return (0.5f * height * light_up) * value * glm::vec2(over_all[0], over_all[2]);
}

} // namespace tsuya

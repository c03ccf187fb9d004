#pragma once
/// \file
/// The distribution of normals of the filaments of both yarn systems, as a table.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// For light that left filaments: a cylinder's normals spread uniformly about its axis, and the
/// sine of their angle with the plane across the axis is normally distributed, so that they can be
/// sampled in closed form. D of one system depends on two components of a unit half vector: the one
/// along the yarns, and the height. Bilinear over the angle between these two and over the length
/// of the part that they make.
class YarnFacets {
  public:
    YarnFacets() = default;
    /// \param roughness standard deviation of the sine, above 0; nodes resolve 0.05 and more
    YarnFacets(const YarnLobes &lobes, double roughness);

    /// D in 1/sr of weft and warp for a surface of 1 in all; its integral over the hemisphere is 1.
    /// \param half unit, z >= 0
    glm::vec2 at(const glm::vec3 &half) const {
        return {at(0, half.x, half.y, half.z), at(1, half.y, half.x, half.z)};
    }
    /// Samples a half vector of either system with the density of the sum. Of `u` in [0, 1)^3 the
    /// last coordinate takes the slope.
    /// \return unit, z >= 0; zero where the sine that was taken is none
    glm::vec3 sample(const glm::vec3 &u) const;

    /// There is no filament.
    bool empty() const { return slopes_.empty(); }
    /// As much filament lies at each slope as at its opposite.
    bool mirrored() const { return mirrored_; }
    std::size_t bytes() const;

  private:
    template <class F, detail::MaybeConst<YarnFacets> T> friend void each_part(F &&f, T &t) {
        auto &[roughness, mirrored, all, slopes, table] = t;
        f(roughness, mirrored, all, slopes, table);
    }

    static constexpr int kAngles = 161, kLengths = 49;

    /// The filaments of one system at one slope.
    struct Slope {
        float up_to;        ///< share of all filaments up to and with these
        float sine, cosine; ///< of the slope
        int axis;
    };

    float at(std::size_t axis, float along, float across, float up) const;
    double sum_at(const YarnLobes &lobes, std::size_t axis, double along, double up) const;
    void list_slopes(const YarnLobes &lobes);
    void tabulate(const YarnLobes &lobes);

    float roughness_ = 0;
    bool mirrored_ = true;
    double all_ = 0; ///< surface of both systems
    std::vector<Slope> slopes_{};
    std::array<std::vector<float>, 2> table_{}; ///< [angle][length]
};

inline float YarnFacets::at(std::size_t axis, float along, float across, float up) const {
    constexpr float kSmallest = 1e-20f;
    const float sum = std::abs(along) + up + kSmallest;
    const float turn =
        (mirrored_ ? std::abs(along) : along) / sum; // the angle, without arc tangent
    const float length = std::sqrt(std::max(1 - across * across, 0.0f));
    const float x = (mirrored_ ? turn : 0.5f * (turn + 1)) * (kAngles - 1);
    const float y = length * (kLengths - 1);
    const int i = std::clamp(static_cast<int>(x), 0, kAngles - 2);
    const int j = std::clamp(static_cast<int>(y), 0, kLengths - 2);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const float *const row = &table_[axis][static_cast<std::size_t>(i * kLengths + j)];
    const float *const next = row + kLengths;
    return (1 - s) * ((1 - t) * row[0] + t * row[1]) + s * ((1 - t) * next[0] + t * next[1]);
}

} // namespace tsuya

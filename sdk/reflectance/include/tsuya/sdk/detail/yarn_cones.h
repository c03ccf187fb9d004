#pragma once
/// \file
/// Samples light that yarns send on along the cones about their axes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// Light for a view, or the other way round. With theta and phi of both from the plane across the
/// yarn and about its axis, a level filament has its normal at an angle from that plane of about
///
///     tan(angle) = tan((theta_l + theta_v) / 2) / cos((phi_l - phi_v) / 2),
///
/// exactly where the thetas or the phis are equal. sin(phi_l) is sampled by a table for each
/// sin(phi_v), and the angle by the slopes of the yarns; both give the light in closed form.
class YarnCones {
  public:
    YarnCones() = default;
    /// \param lobes with a surface above 0 at some slope
    /// \param width by which the slopes are blurred, standard deviation in radians, above 0
    /// \param about_yarn what the light does about the yarn: above 0, of the cosine of its turn
    YarnCones(const YarnLobes &lobes, double width, const std::function<float(float)> &about_yarn);

    /// Density of sampling `free` for `fixed`, 1/sr; unit, z > 0.
    /// \param turned cosines of the angle between the two about the weft (x) and the warp (y)
    float density(const glm::vec3 &free, const glm::vec3 &fixed, const glm::vec2 &turned) const {
        return density(0, free.x, free.y, free.z, fixed.x, fixed.y, turned.x) +
               density(1, free.y, free.x, free.z, fixed.y, fixed.x, turned.y);
    }
    /// \param u in [0, 1)^3
    /// \return unit, z >= 0; zero where no such direction exists
    glm::vec3 sample(const glm::vec3 &fixed, const glm::vec3 &u) const;

    std::size_t bytes() const { return sines_.bytes() + turns_.bytes(); }

  private:
    template <class F, detail::MaybeConst<YarnCones> T> friend void each_part(F &&f, T &t) {
        auto &[sines, turns] = t;
        f(sines, turns);
    }

    static constexpr float kLeast = 1e-12f;
    /// Of a direction, the sine with the yarn: nearer to it nothing is sampled, where the density
    /// would grow without bound.
    static constexpr float kLeastAcross = 0.1f;
    /// Four halves: the height of a system's row, the scales of both tables, half the thetas' sum.
    static constexpr float kScale = 1.0f / 16;

    float density(std::size_t axis, float along, float beside, float up, float fixed_along,
                  float fixed_beside, float turned) const;

    Distribution2D sines_{}; ///< [axis][(1 + sine of the angle) / 2]
    Distribution2D turns_{}; ///< [(1 + sin phi) / 2 of the fixed direction][the same of the free]
};

inline float YarnCones::density(std::size_t axis, float along, float beside, float up,
                                float fixed_along, float fixed_beside, float turned) const {
    const float across2 = 1 - along * along;
    if (across2 <= kLeastAcross * kLeastAcross)
        return 0;
    const float over_across = 1 / std::sqrt(across2);
    const float fixed_across = std::sqrt(std::max(1 - fixed_along * fixed_along, kLeast));
    // The tangent of half the sum of the thetas, and with it that of the normal
    const float half = (along + fixed_along) * over_across / (1 + fixed_across * over_across);
    const float over_turn = 1 / std::sqrt(std::max(0.5f + 0.5f * turned, kLeast));
    const float tangent = half * over_turn;
    const float over_secant = 1 / std::sqrt(1 + tangent * tangent);
    const float at_sine =
        sines_.density({0.5f + 0.5f * tangent * over_secant, axis == 0 ? 0.0f : 0.75f});
    const float at_turn = turns_.density_along(0.5f + 0.5f * fixed_beside / fixed_across,
                                               0.5f + 0.5f * beside * over_across);
    return at_sine * at_turn * (over_secant * over_secant * over_secant) * (1 + half * half) *
           over_turn * (over_across * over_across) * up * kScale;
}

} // namespace tsuya

#pragma once
/// \file
/// Samples one direction for another from tables, for models whose formula cannot be inverted.

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/distribution.h"
#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// Densities over the hemisphere for a grid of fixed directions, even in azimuth and denser in
/// theta towards grazing. Between the fixed directions one of the four about is taken by chance,
/// and the density is their mean: exact everywhere, and above 0 everywhere.
class DirectionSampler {
  public:
    using Density = std::function<float(const glm::vec3 &fixed, const glm::vec3 &drawn)>;

    DirectionSampler() = default;
    /// \param density to be followed, >= 0, finite, up to a factor; called from several threads
    explicit DirectionSampler(const Density &density);

    /// \param fixed unit, z > 0
    /// \return unit, z >= 0
    glm::vec3 sample(const glm::vec3 &fixed, const glm::vec3 &u) const;
    /// 1/sr of `drawn`; both unit with z > 0.
    float pdf(const glm::vec3 &fixed, const glm::vec3 &drawn) const;

  private:
    template <class F, detail::MaybeConst<DirectionSampler> T> friend void each_part(F &&f, T &t) {
        auto &[density] = t;
        f(density);
    }

    std::vector<Distribution2D> density_{}; ///< [row from the horizon to the pole][azimuth]
};

} // namespace tsuya

#pragma once
/// \file
/// The albedo of a reciprocal model that is held at 1, and the factor that holds it.

#include <algorithm>
#include <functional>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/albedo_table.h"
#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// A model scaled by the smaller `limit` of its two directions reflects no more than it receives
/// from either, and stays reciprocal.
class LimitedAlbedo {
  public:
    /// \param albedo the model's at a direction, with the `limit` of this object as it is at the
    /// call: 1 in a first round, and in a second where there is something to limit. From several
    /// threads
    /// \param columns_of_quarter as of AlbedoTable
    void tabulate(Symmetry symmetry, const std::function<float(const glm::vec3 &)> &albedo,
                  int columns_of_quarter = 8);

    /// Factor in (0, 1]. \param direction unit, z > 0
    float limit(const glm::vec3 &direction) const {
        return direction.z < limited_below_ ? 1 / std::max(1.0f, unlimited_.at(direction)) : 1.0f;
    }
    /// The albedo with the limit, 0 where z <= 0.
    float at(const glm::vec3 &direction) const {
        return direction.z > 0 ? std::min(1.0f, albedo_.at(direction)) : 0.0f;
    }
    /// Largest before the limit.
    float unlimited_maximum() const { return unlimited_maximum_; }

  private:
    template <class F, detail::MaybeConst<LimitedAlbedo> T> friend void each_part(F &&f, T &t) {
        auto &[unlimited, albedo, unlimited_maximum, limited_below] = t;
        f(unlimited, albedo, unlimited_maximum, limited_below);
    }

    AlbedoTable unlimited_{}, albedo_{};
    float unlimited_maximum_ = 0;
    float limited_below_ = 0; ///< cosine from which on nothing is limited
};

} // namespace tsuya

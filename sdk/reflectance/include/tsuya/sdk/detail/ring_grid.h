#pragma once
/// \file
/// Directions as goniometers measure them, ring by ring, and what lies between them.

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// Directions on rings about the normal, each ring with azimuths of its own, and the shares with
/// which those about a direction stand for it: linear along the ring and between rings.
class RingGrid {
  public:
    struct Corner {
        std::size_t index = 0; ///< into the directions the grid was made of
        float weight = 0;
    };
    struct Corners {
        Corner corner[4];
        int count = 0;
    };

    RingGrid() = default;
    /// \param directions unit, z >= 0; at least one, no two alike
    explicit RingGrid(const std::vector<glm::dvec3> &directions);
    Corners about(const glm::vec3 &direction) const;

  private:
    template <class F, detail::MaybeConst<RingGrid> T> friend void each_part(F &&f, T &t) {
        auto &[rings] = t;
        f(rings);
    }

    struct Ring {
        float theta = 0;
        std::vector<float> phi{}; ///< ascending, in [0, 2 pi)
        std::vector<std::size_t> index{};

        template <class F, detail::MaybeConst<Ring> T> friend void each_part(F &&f, T &t) {
            auto &[of_theta, of_phi, of_index] = t;
            f(of_theta, of_phi, of_index);
        }
    };
    void add(const Ring &ring, float phi, float share, Corners &corners) const;

    std::vector<Ring> rings_{}; ///< by theta
};

} // namespace tsuya

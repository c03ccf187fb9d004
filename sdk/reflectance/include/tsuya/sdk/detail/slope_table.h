#pragma once
/// \file
/// The distribution of normals of the filaments of both yarn systems as a table.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/spline.h"
#include "tsuya/sdk/detail/table_parts.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// D of one system depends on the half vector's turn about the axis across the yarn, in which it is
/// as narrow as the filaments are smooth, and on the length of its part in the plane along the
/// yarn. The table is over both: a quadratic spline through its nodes, smooth.
class SlopeTable {
  public:
    SlopeTable() = default;
    /// \param mirrored as much filament lies at each slope as at its opposite
    SlopeTable(const YarnLobes &lobes, bool mirrored, const Progress &progress);

    /// D of weft and warp in 1/sr, as yarn_facets.
    /// \param half unit, z >= 0
    glm::vec2 at(const glm::vec3 &half) const;
    std::size_t bytes() const { return (value_[0].size() + value_[1].size()) * sizeof(float); }

  private:
    template <class F, detail::MaybeConst<SlopeTable> T> friend void each_part(F &&f, T &t) {
        auto &[mirrored, nodes, columns, value] = t;
        f(mirrored, nodes, columns, value);
    }

    static constexpr int kRows = 65; ///< over the root of the length

    bool mirrored_ = true;
    int nodes_ = 0;   ///< along a row, without those beyond its ends
    int columns_ = 0; ///< with them
    /// [row][column], with a row or column beyond each end
    std::array<std::vector<float>, 2> value_{};
};

inline glm::vec2 SlopeTable::at(const glm::vec3 &half) const {
    constexpr float kSmallest = 1e-20f;
    const float up = std::max(half.z, 0.0f), last = static_cast<float>(nodes_ - 1);
    const FourFloats along{half.x, half.x, half.y, half.y}, size = size_of(along);
    // The angle without arc tangent: x / (x + y)
    FourFloats turn = (mirrored_ ? size : along) / (size + (up + kSmallest));
    if (!mirrored_)
        turn = 0.5f * (turn + 1.0f);
    const FourFloats root = root_of(root_of(along * along + up * up));
    const SplinePlaces places(FourFloats{turn[0], root[1], turn[2], root[3]} *
                                  FourFloats{last, kRows - 1, last, kRows - 1},
                              FourFloats{last, kRows - 1, last, kRows - 1});
    const auto line = [&](std::size_t axis, int turned, int length) {
        return spline_between_lines(&value_[axis][static_cast<std::size_t>(
                                        places.first[length] * columns_ + places.first[turned])],
                                    columns_, places.from[length]);
    };
    // A spline passes below 0 where a lobe ends
    const FourFloats made =
        largest(spline_along_lines(line(0, 0, 1), line(1, 2, 3),
                                   FourFloats{places.from[0], places.from[2], 0, 0}),
                four(0));
    return {made[0], made[1]};
}

} // namespace tsuya

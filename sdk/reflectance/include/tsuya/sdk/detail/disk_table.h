#pragma once
/// \file
/// A function of direction as a table on the equal-area disk of the hemisphere.

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// Bilinear table over the upper hemisphere; one quadrant where the function is orthotropic.
class DiskTable {
  public:
    DiskTable() = default;
    /// \param nodes along one axis of the quadrant (orthotropic) or of the whole square
    DiskTable(int nodes, bool orthotropic, const std::function<float(const glm::vec3 &)> &function);
    /// \param direction unit, z >= 0
    float at(const glm::vec3 &direction) const {
        const float scale = scale_of(direction.z);
        return at_disk(direction.x * scale, direction.y * scale);
    }
    /// What takes the horizontal part of a direction to its point of the disk. It is 1 / sqrt(1 +
    /// z), which would keep areas, but for at most 2.1 %, and takes less time.
    static float scale_of(float z) { return 1 - z * (0.5f - 0.20710678f * z); }
    /// \param x, y a point of the unit disk
    float at_disk(float x, float y) const {
        const Cell c = cell_of(x, y);
        const float *const row = &value_[c.index], *const next = row + nodes_;
        return (1 - c.t) * ((1 - c.s) * row[0] + c.s * row[1]) +
               c.t * ((1 - c.s) * next[0] + c.s * next[1]);
    }

    /// Where a point lies: its first node of four, and the shares of the next column and row.
    struct Cell {
        std::uint32_t index;
        float s, t;
    };
    Cell cell_of(float x, float y) const {
        x = std::bit_cast<float>(std::bit_cast<std::uint32_t>(x) & sign_) * scale_ + offset_;
        y = std::bit_cast<float>(std::bit_cast<std::uint32_t>(y) & sign_) * scale_ + offset_;
        // Conversion cuts towards 0: rounding below the first node stays at it. What is no number
        // becomes a large index, and so the last.
        const auto last = static_cast<std::uint32_t>(nodes_ - 2);
        const auto i = static_cast<std::uint32_t>(static_cast<std::int32_t>(x));
        const auto j = static_cast<std::uint32_t>(static_cast<std::int32_t>(y));
        const std::uint32_t column = i < last ? i : last, row = j < last ? j : last;
        return {row * static_cast<std::uint32_t>(nodes_) + column,
                x - static_cast<float>(static_cast<std::int32_t>(column)),
                y - static_cast<float>(static_cast<std::int32_t>(row))};
    }
    const float *data() const { return value_.data(); }
    int nodes() const { return nodes_; }
    std::size_t bytes() const { return value_.size() * sizeof(float); }

  private:
    template <class F, detail::MaybeConst<DiskTable> T> friend void each_part(F &&f, T &t) {
        auto &[nodes, sign, scale, offset, value] = t;
        f(nodes, sign, scale, offset, value);
    }

    int nodes_ = 0;
    std::uint32_t sign_ = 0x7fffffff; ///< the bits of a coordinate that are kept: folds quadrants
    float scale_ = 0, offset_ = 0;    ///< from the disk to nodes
    std::vector<float> value_{};
};

} // namespace tsuya

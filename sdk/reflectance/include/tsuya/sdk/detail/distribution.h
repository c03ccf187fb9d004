#pragma once
/// \file
/// A piecewise constant density on a rectangle of cells, sampled by inversion.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/table_parts.h"

namespace tsuya {

/// Samples a point of [0,1) x [0,1) with a density proportional to the weight of its cell.
class Distribution2D {
  public:
    Distribution2D() = default;
    /// \param weights rows * columns masses of the cells, >= 0, finite; all 0 counts as all 1
    /// \param rows, columns 1 to 65535
    Distribution2D(std::span<const double> weights, int rows, int columns);

    struct Sample {
        glm::vec2 point; ///< x along columns, y along rows
        float density;   ///< with respect to the unit square
    };
    /// \param u in [0,1)^2
    Sample sample(glm::vec2 u) const;
    /// Density at a point of the unit square.
    float density(glm::vec2 point) const {
        return density_of(cell_of(point.y, rows_), cell_of(point.x, columns_));
    }
    /// The same of a cell.
    float density_of(std::size_t row, std::size_t column) const {
        const float *const cdf = &column_cdf_[row * (columns_ + 1) + column];
        return row_density_[row] * (cdf[1] - cdf[0]);
    }
    /// A place along the row at y alone, with respect to the unit length.
    float sample_along(float y, float u) const {
        const std::size_t row = cell_of(y, rows_);
        const Draw column =
            invert(&column_cdf_[row * (columns_ + 1)], &column_guide_[row * columns_], columns_, u);
        return (static_cast<float>(column.cell) + column.offset) / static_cast<float>(columns_);
    }
    /// Density of `sample_along`.
    float density_along(float y, float x) const {
        const float *const cdf =
            &column_cdf_[cell_of(y, rows_) * (columns_ + 1) + cell_of(x, columns_)];
        return static_cast<float>(columns_) * (cdf[1] - cdf[0]);
    }
    std::size_t bytes() const {
        return (row_cdf_.size() + row_density_.size() + column_cdf_.size()) * sizeof(float) +
               (row_guide_.size() + column_guide_.size()) * sizeof(std::uint16_t);
    }

  private:
    template <class F, detail::MaybeConst<Distribution2D> T> friend void each_part(F &&f, T &t) {
        auto &[rows, columns, row_cdf, row_density, column_cdf, row_guide, column_guide] = t;
        f(rows, columns, row_cdf, row_density, column_cdf, row_guide, column_guide);
    }

    struct Draw {
        std::size_t cell;
        float offset; ///< in [0, 1)
    };
    static std::size_t cell_of(float x, std::size_t cells) {
        // What is below 0 or no number becomes a large index, and so the last
        const auto cell = static_cast<std::uint32_t>(
            static_cast<std::int32_t>(x * static_cast<float>(static_cast<std::int32_t>(cells))));
        return std::min<std::size_t>(cell, cells - 1);
    }
    static Draw invert(const float *cdf, const std::uint16_t *guide, std::size_t cells, float u);

    std::size_t rows_ = 0, columns_ = 0;
    std::vector<float> row_cdf_{};     ///< rows + 1
    std::vector<float> row_density_{}; ///< of the unit square: mass of the row times all cells
    std::vector<float> column_cdf_{};  ///< [row][column], columns + 1 each
    /// Where the search in a cumulative sum begins, for even steps of u: one step a cell
    std::vector<std::uint16_t> row_guide_{}, column_guide_{};
};

inline Distribution2D::Draw Distribution2D::invert(const float *cdf, const std::uint16_t *guide,
                                                   std::size_t cells, float u) {
    const auto step = static_cast<std::size_t>(static_cast<int>(u * static_cast<float>(cells)));
    std::size_t cell = guide[std::min(step, cells - 1)];
    // Mostly the first cell or the next. Branch-free: this branch is unpredictable
    cell +=
        static_cast<std::size_t>(cell + 1 < cells) & static_cast<std::size_t>(cdf[cell + 1] <= u);
    while (cell + 1 < cells && cdf[cell + 1] <= u)
        ++cell;
    const float width = cdf[cell + 1] - cdf[cell];
    const float offset = width > 0 ? (u - cdf[cell]) / width : 0.5f;
    return {cell, std::clamp(offset, 0.0f, 0x1.fffffep-1f)};
}

inline Distribution2D::Sample Distribution2D::sample(glm::vec2 u) const {
    const Draw row = invert(row_cdf_.data(), row_guide_.data(), rows_, u.y);
    const float *const cdf = &column_cdf_[row.cell * (columns_ + 1)];
    const Draw column = invert(cdf, &column_guide_[row.cell * columns_], columns_, u.x);
    return {{(static_cast<float>(column.cell) + column.offset) / static_cast<float>(columns_),
             (static_cast<float>(row.cell) + row.offset) / static_cast<float>(rows_)},
            row_density_[row.cell] * (cdf[column.cell + 1] - cdf[column.cell])};
}

} // namespace tsuya

#pragma once
/// \file
/// A piecewise constant density on a rectangle of cells, sampled by inversion.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// Draws a point of [0,1) x [0,1) with a density proportional to the weight of its cell.
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
    float density(glm::vec2 point) const;
    std::size_t bytes() const {
        return (row_cdf_.size() + column_cdf_.size()) * sizeof(float) +
               (row_guide_.size() + column_guide_.size()) * sizeof(std::uint16_t);
    }

  private:
    struct Draw {
        std::size_t cell;
        float offset; ///< in [0, 1)
    };
    static Draw invert(const float *cdf, const std::uint16_t *guide, std::size_t cells, float u);

    std::size_t rows_ = 0, columns_ = 0;
    std::vector<float> row_cdf_{};    ///< rows + 1
    std::vector<float> column_cdf_{}; ///< [row][column], columns + 1 each
    /// Where the search in a cumulative sum begins, for even steps of u: one step a cell
    std::vector<std::uint16_t> row_guide_{}, column_guide_{};
};

} // namespace tsuya

#pragma once
/// \file
/// A piecewise constant density on a rectangle of cells, sampled by inversion.

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya {

/// Draws a point of [0,1) x [0,1) with a density proportional to the weight of its cell.
class Distribution2D {
  public:
    Distribution2D() = default;
    /// \param weights rows * columns masses of the cells, >= 0, finite; all 0 counts as all 1
    Distribution2D(std::span<const double> weights, int rows, int columns);

    struct Sample {
        glm::vec2 point; ///< x along columns, y along rows
        float density;   ///< with respect to the unit square
    };
    /// \param u in [0,1)^2
    Sample sample(glm::vec2 u) const;
    /// Density at a point of the unit square.
    float density(glm::vec2 point) const;

  private:
    int rows_ = 0, columns_ = 0;
    std::vector<float> density_{};    ///< [row][column]
    std::vector<float> row_cdf_{};    ///< rows + 1
    std::vector<float> column_cdf_{}; ///< [row][column], columns + 1 each
};

} // namespace tsuya

#include "tsuya/sdk/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tsuya {
namespace {

// Cumulative sums of `weights`, from 0 to exactly 1; even where all are 0.
void make_cdf(std::span<const double> weights, float *cdf) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        cdf[i] = static_cast<float>(sum);
        sum += total > 0 ? weights[i] / total : 1.0 / static_cast<double>(weights.size());
    }
    cdf[weights.size()] = 1.0f;
}

// The last cell that begins at or below each of `cells` even steps of u.
void make_guide(const float *cdf, std::size_t cells, std::uint16_t *guide) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(cells);
        while (cell + 1 < cells && cdf[cell + 1] <= u)
            ++cell;
        guide[i] = static_cast<std::uint16_t>(cell);
    }
}

} // namespace

Distribution2D::Draw Distribution2D::invert(const float *cdf, const std::uint16_t *guide,
                                            std::size_t cells, float u) {
    const auto step = static_cast<std::size_t>(u * static_cast<float>(cells));
    std::size_t cell = guide[std::min(step, cells - 1)];
    // Rounding may have put u into the step before its own
    while (cell > 0 && cdf[cell] > u)
        --cell;
    while (cell + 1 < cells && cdf[cell + 1] <= u)
        ++cell;
    const float width = cdf[cell + 1] - cdf[cell];
    const float offset = width > 0 ? (u - cdf[cell]) / width : 0.5f;
    return {cell, std::clamp(offset, 0.0f, 0x1.fffffep-1f)};
}

Distribution2D::Distribution2D(std::span<const double> weights, int rows, int columns)
    : rows_(static_cast<std::size_t>(rows)), columns_(static_cast<std::size_t>(columns)),
      row_cdf_(rows_ + 1), column_cdf_(rows_ * (columns_ + 1)), row_guide_(rows_),
      column_guide_(rows_ * columns_) {
    std::vector<double> row_mass(rows_);
    for (std::size_t i = 0; i < rows_; ++i) {
        const auto row = weights.subspan(i * columns_, columns_);
        row_mass[i] = std::accumulate(row.begin(), row.end(), 0.0);
        float *const cdf = &column_cdf_[i * (columns_ + 1)];
        make_cdf(row, cdf);
        make_guide(cdf, columns_, &column_guide_[i * columns_]);
    }
    make_cdf(row_mass, row_cdf_.data());
    make_guide(row_cdf_.data(), rows_, row_guide_.data());
}

Distribution2D::Sample Distribution2D::sample(glm::vec2 u) const {
    const Draw row = invert(row_cdf_.data(), row_guide_.data(), rows_, u.y);
    const float *const cdf = &column_cdf_[row.cell * (columns_ + 1)];
    const Draw column = invert(cdf, &column_guide_[row.cell * columns_], columns_, u.x);
    return {{(static_cast<float>(column.cell) + column.offset) / static_cast<float>(columns_),
             (static_cast<float>(row.cell) + row.offset) / static_cast<float>(rows_)},
            (row_cdf_[row.cell + 1] - row_cdf_[row.cell]) *
                (cdf[column.cell + 1] - cdf[column.cell]) * static_cast<float>(rows_ * columns_)};
}

float Distribution2D::density(glm::vec2 point) const {
    const auto cell = [](float x, std::size_t cells) {
        const auto at = static_cast<int>(x * static_cast<float>(cells));
        return static_cast<std::size_t>(std::clamp(at, 0, static_cast<int>(cells) - 1));
    };
    const std::size_t row = cell(point.y, rows_), column = cell(point.x, columns_);
    const float *const cdf = &column_cdf_[row * (columns_ + 1) + column];
    return (row_cdf_[row + 1] - row_cdf_[row]) * (cdf[1] - cdf[0]) *
           static_cast<float>(rows_ * columns_);
}

} // namespace tsuya

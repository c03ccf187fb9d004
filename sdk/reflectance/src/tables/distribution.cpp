#include "tsuya/sdk/detail/distribution.h"

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

// The last cell that begins at or below each of `cells` even steps of u, a little before which a
// rounded u may lie.
void make_guide(const float *cdf, std::size_t cells, std::uint16_t *guide) {
    std::size_t cell = 0;
    for (std::size_t i = 0; i < cells; ++i) {
        const float u = static_cast<float>(i) / static_cast<float>(cells) * (1 - 1e-6f);
        while (cell + 1 < cells && cdf[cell + 1] <= u)
            ++cell;
        guide[i] = static_cast<std::uint16_t>(cell);
    }
}

} // namespace

Distribution2D::Distribution2D(std::span<const double> weights, int rows, int columns)
    : rows_(static_cast<std::size_t>(rows)), columns_(static_cast<std::size_t>(columns)),
      row_cdf_(rows_ + 1), row_density_(rows_), column_cdf_(rows_ * (columns_ + 1)),
      row_guide_(rows_), column_guide_(rows_ * columns_) {
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
    for (std::size_t i = 0; i < rows_; ++i)
        row_density_[i] = (row_cdf_[i + 1] - row_cdf_[i]) * static_cast<float>(rows_ * columns_);
}

} // namespace tsuya

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

struct Draw {
    int cell;
    float offset; ///< in [0, 1)
};

Draw invert(const float *cdf, int cells, float u) {
    const float *const upper = std::upper_bound(cdf + 1, cdf + cells, u);
    const auto cell = static_cast<int>(upper - cdf) - 1;
    const float width = cdf[cell + 1] - cdf[cell];
    const float offset = width > 0 ? (u - cdf[cell]) / width : 0.5f;
    return {cell, std::clamp(offset, 0.0f, 0x1.fffffep-1f)};
}

} // namespace

Distribution2D::Distribution2D(std::span<const double> weights, int rows, int columns)
    : rows_(rows), columns_(columns) {
    const auto r = static_cast<std::size_t>(rows), c = static_cast<std::size_t>(columns);
    column_cdf_.resize(r * (c + 1));
    row_cdf_.resize(r + 1);
    density_.resize(r * c);
    std::vector<double> row_mass(r);
    for (std::size_t i = 0; i < r; ++i) {
        const auto row = weights.subspan(i * c, c);
        row_mass[i] = std::accumulate(row.begin(), row.end(), 0.0);
        make_cdf(row, &column_cdf_[i * (c + 1)]);
    }
    make_cdf(row_mass, row_cdf_.data());
    // The density that `sample` really has: from the rounded cumulative sums
    for (std::size_t i = 0; i < r; ++i)
        for (std::size_t j = 0; j < c; ++j) {
            const float *const cdf = &column_cdf_[i * (c + 1)];
            density_[i * c + j] =
                (row_cdf_[i + 1] - row_cdf_[i]) * (cdf[j + 1] - cdf[j]) * static_cast<float>(r * c);
        }
}

Distribution2D::Sample Distribution2D::sample(glm::vec2 u) const {
    const Draw row = invert(row_cdf_.data(), rows_, u.y);
    const auto r = static_cast<std::size_t>(row.cell), c = static_cast<std::size_t>(columns_);
    const Draw column = invert(&column_cdf_[r * (c + 1)], columns_, u.x);
    return {{(static_cast<float>(column.cell) + column.offset) / static_cast<float>(columns_),
             (static_cast<float>(row.cell) + row.offset) / static_cast<float>(rows_)},
            density_[r * c + static_cast<std::size_t>(column.cell)]};
}

float Distribution2D::density(glm::vec2 point) const {
    const int row = std::clamp(static_cast<int>(point.y * static_cast<float>(rows_)), 0, rows_ - 1);
    const int column =
        std::clamp(static_cast<int>(point.x * static_cast<float>(columns_)), 0, columns_ - 1);
    return density_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
}

} // namespace tsuya

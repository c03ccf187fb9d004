#pragma once
/// \file
/// The distribution of normals of the filaments of both yarn systems as a table.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/yarn_lobes.h"

namespace tsuya {

/// D of one system depends on the half vector's turn about the axis across the yarn, in which it is
/// as narrow as the filaments are smooth, and on the length of its part in the plane along the
/// yarn. The table is over both, cubic between its nodes, so that it is smooth.
class SlopeTable {
  public:
    SlopeTable() = default;
    /// \param mirrored as much filament lies at each slope as at its opposite
    SlopeTable(const YarnLobes &lobes, bool mirrored, const Progress &progress);

    /// D in 1/sr, as yarn_facets.
    /// \tparam kAxis 0 for yarns along the weft, 1 for the warp
    /// \param half unit, z >= 0
    template <int kAxis> float at(const glm::vec3 &half) const;
    std::size_t bytes() const { return (value_[0].size() + value_[1].size()) * sizeof(float); }

  private:
    static constexpr int kRows = 65; ///< over the root of the length

    /// Weights of four nodes at a place between the second and third of them ([Keys], a = -1/2).
    static glm::vec4 weights(float t) {
        const float s = 1 - t;
        return {-0.5f * t * s * s, 1 + t * t * (1.5f * t - 2.5f), 1 + s * s * (1.5f * s - 2.5f),
                -0.5f * s * t * t};
    }

    bool mirrored_ = true;
    int nodes_ = 0;   ///< along a row, without those beyond its ends
    int columns_ = 0; ///< with them
    /// [row][column], with a row or column beyond each end
    std::array<std::vector<float>, 2> value_{};
};

template <int kAxis> float SlopeTable::at(const glm::vec3 &half) const {
    constexpr float kSmallest = 1e-20f;
    const float along = half[kAxis], up = std::max(half.z, 0.0f);
    // The angle without arc tangent: x / (x + y)
    const float turn = (mirrored_ ? std::abs(along) : along) / (std::abs(along) + up + kSmallest);
    const float x = (mirrored_ ? turn : 0.5f * (turn + 1)) * static_cast<float>(nodes_ - 1);
    const float y = std::sqrt(std::sqrt(along * along + up * up)) * (kRows - 1);
    const int i = std::min(static_cast<int>(x), nodes_ - 2);
    const int j = std::min(static_cast<int>(y), kRows - 2);
    const glm::vec4 wx = weights(x - static_cast<float>(i));
    const glm::vec4 wy = weights(y - static_cast<float>(j));
    const float *row = &value_[kAxis][static_cast<std::size_t>(j * columns_ + i)];
    float sum = 0;
    for (int k = 0; k < 4; ++k, row += columns_)
        sum += wy[k] * (wx[0] * row[0] + wx[1] * row[1] + wx[2] * row[2] + wx[3] * row[3]);
    return std::max(sum, 0.0f); // a cubic passes below 0 where a lobe ends
}

} // namespace tsuya

#include "tsuya/sdk/detail/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "tables/azimuth.h"

namespace tsuya {
namespace {

constexpr int kRows = 33;        // over sqrt(cos theta): 0.06 degrees at the horizon
constexpr float kLowest = 1e-5f; // cosine that stands for the horizon itself

glm::vec3 direction_of(float quarter, float root_cosine) {
    const float z = std::max(root_cosine * root_cosine, kLowest);
    return {azimuth_of(quarter) * std::sqrt(std::max(0.0f, 1 - z * z)), z};
}

// How many quarters differ from each other.
int held_quarters(Symmetry symmetry) {
    return symmetry == Symmetry::orthotropic ? 1 : symmetry == Symmetry::half_turn ? 2 : 4;
}

std::vector<float> values_at(const std::vector<glm::vec3> &nodes,
                             const std::function<float(const glm::vec3 &)> &function) {
    std::vector<float> values(nodes.size());
    tbb::parallel_for(std::size_t{0}, nodes.size(),
                      [&](std::size_t n) { values[n] = function(nodes[n]); });
    return values;
}

} // namespace

AlbedoTable::AlbedoTable(Symmetry symmetry, std::vector<float> values, int columns_of_quarter)
    : symmetry_(symmetry), columns_of_quarter_(columns_of_quarter),
      columns_(held_quarters(symmetry) * columns_of_quarter + 1), value_(std::move(values)) {}

AlbedoTable::AlbedoTable(Symmetry symmetry, const std::function<float(const glm::vec3 &)> &function,
                         int columns_of_quarter)
    : AlbedoTable(symmetry, values_at(nodes(symmetry, columns_of_quarter), function),
                  columns_of_quarter) {}

std::vector<glm::vec3> AlbedoTable::nodes(Symmetry symmetry, int columns_of_quarter) {
    std::vector<glm::vec3> all;
    for (int j = 0; j < kRows; ++j)
        for (int i = 0; i <= held_quarters(symmetry) * columns_of_quarter; ++i)
            all.push_back(
                direction_of(static_cast<float>(i) / static_cast<float>(columns_of_quarter),
                             static_cast<float>(j) / (kRows - 1)));
    return all;
}

float AlbedoTable::at(const glm::vec3 &direction) const {
    float q = quarters(direction);
    if (symmetry_ == Symmetry::orthotropic)
        q = std::abs(direction.y) / std::max(std::abs(direction.x) + std::abs(direction.y), 1e-30f);
    else if (symmetry_ == Symmetry::half_turn && q >= 2)
        q -= 2;
    const float x = q * static_cast<float>(columns_of_quarter_);
    const float y = std::sqrt(glm::clamp(direction.z, 0.0f, 1.0f)) * (kRows - 1);
    const int i = std::min(static_cast<int>(x), columns_ - 2);
    const int j = std::min(static_cast<int>(y), kRows - 2);
    const float s = std::min(x - static_cast<float>(i), 1.0f), t = y - static_cast<float>(j);
    const float *const row = &value_[static_cast<std::size_t>(j * columns_ + i)];
    const float *const next = row + columns_;
    return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
}

float AlbedoTable::maximum() const { return *std::max_element(value_.begin(), value_.end()); }

float AlbedoTable::cosine_above(float value) const {
    const auto last =
        std::find_if(value_.rbegin(), value_.rend(), [&](float v) { return v > value; });
    if (last == value_.rend())
        return 0;
    const auto row = static_cast<int>(value_.rend() - last - 1) / columns_;
    if (row == kRows - 1)
        return 2;
    // Interpolation carries the row's excess towards the next; it is linear along the row too, so
    // that it reaches farthest at a column
    float reach = 0;
    for (int i = 0; i < columns_; ++i) {
        const float *const here = &value_[static_cast<std::size_t>(row * columns_ + i)];
        if (here[0] > value)
            reach = std::max(reach, (here[0] - value) / (here[0] - here[columns_]));
    }
    const float root = (static_cast<float>(row) + reach) / (kRows - 1);
    return root * root * (1 + 1e-5f); // the place of a direction is rounded
}

} // namespace tsuya

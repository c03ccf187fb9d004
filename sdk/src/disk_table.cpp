#include "tsuya/sdk/disk_table.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "disk.h"

namespace tsuya {

DiskTable::DiskTable(int nodes, bool orthotropic,
                     const std::function<float(const glm::vec3 &)> &function)
    : nodes_(nodes), orthotropic_(orthotropic),
      value_(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes)) {
    const float step = 1.0f / static_cast<float>(nodes - 1);
    tbb::parallel_for(0, nodes, [&](int j) {
        for (int i = 0; i < nodes; ++i) {
            glm::vec2 p = glm::vec2(i, j) * step;
            if (!orthotropic_)
                p = 2.0f * p - 1.0f;
            // Nodes beyond the horizon take the value of the horizon below them
            if (const float r = glm::length(p); r > 1)
                p /= r;
            value_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes) +
                   static_cast<std::size_t>(i)] = function(direction_of_disk(p));
        }
    });
}

float DiskTable::at(const glm::vec3 &direction) const {
    glm::vec2 p = disk_of_direction(direction);
    p = orthotropic_ ? glm::abs(p) : 0.5f * (p + 1.0f);
    const auto last = static_cast<float>(nodes_ - 1);
    const float x = std::clamp(p.x * last, 0.0f, last), y = std::clamp(p.y * last, 0.0f, last);
    const int i = std::min(static_cast<int>(x), nodes_ - 2);
    const int j = std::min(static_cast<int>(y), nodes_ - 2);
    const float s = x - static_cast<float>(i), t = y - static_cast<float>(j);
    const float *const row =
        &value_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes_) +
                static_cast<std::size_t>(i)];
    const float *const next = row + nodes_;
    return (1 - t) * ((1 - s) * row[0] + s * row[1]) + t * ((1 - s) * next[0] + s * next[1]);
}

} // namespace tsuya

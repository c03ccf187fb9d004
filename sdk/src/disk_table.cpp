#include "tsuya/sdk/disk_table.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "disk.h"

namespace tsuya {

DiskTable::DiskTable(int nodes, bool orthotropic,
                     const std::function<float(const glm::vec3 &)> &function)
    : nodes_(nodes), fold_(orthotropic ? 1.0f : 0.0f),
      scale_(static_cast<float>(nodes - 1) * (orthotropic ? 1.0f : 0.5f)),
      offset_(orthotropic ? 0 : scale_),
      value_(static_cast<std::size_t>(nodes) * static_cast<std::size_t>(nodes)) {
    const float step = 1.0f / static_cast<float>(nodes - 1);
    tbb::parallel_for(0, nodes, [&](int j) {
        for (int i = 0; i < nodes; ++i) {
            glm::vec2 p = glm::vec2(i, j) * step;
            if (!orthotropic)
                p = 2.0f * p - 1.0f;
            // Nodes beyond the horizon take the value of the horizon below them
            if (const float r = glm::length(p); r > 1)
                p /= r;
            value_[static_cast<std::size_t>(j) * static_cast<std::size_t>(nodes) +
                   static_cast<std::size_t>(i)] = function(direction_of_disk(p));
        }
    });
}

} // namespace tsuya

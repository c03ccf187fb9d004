#include "tsuya/sdk/detail/disk_table.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace tsuya {
namespace {

// The direction whose point of the disk this is: the height by bisection, for it falls with the
// radius.
glm::vec3 direction_of_point(const glm::vec2 &p) {
    constexpr int kHalvings = 40;
    const double radius = glm::length(glm::dvec2(p));
    double low = 0, high = 1;
    for (int i = 0; i < kHalvings; ++i) {
        const double z = 0.5 * (low + high);
        const double at = std::sqrt(1 - z * z) * (1 - z * (0.5 - 0.20710678 * z));
        (at > radius ? low : high) = z;
    }
    const double sine = std::sqrt(1 - low * low);
    return {glm::dvec2(p) * (radius > 0 ? sine / radius : 0.0), low};
}

} // namespace

DiskTable::DiskTable(int nodes, bool orthotropic,
                     const std::function<float(const glm::vec3 &)> &function)
    : nodes_(nodes), sign_(orthotropic ? 0x7fffffffu : 0xffffffffu),
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
                   static_cast<std::size_t>(i)] = function(direction_of_point(p));
        }
    });
}

} // namespace tsuya

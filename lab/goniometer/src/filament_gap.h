#pragma once
// How far filaments are apart.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::lab {

// A straight piece of a filament: all within `radius` of a segment.
struct Capsule {
    glm::vec3 from, to;
    float radius;
    std::uint32_t strand; // number of the filament
};

// Least distance between the axes of two filaments over the sum of their radii, less 1: below 0
// where they overlap. 1 where all are farther apart than that.
double least_gap(const std::vector<Capsule> &capsules);

} // namespace tsuya::lab

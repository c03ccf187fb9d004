#pragma once
// Views that the symmetry of a cloth makes one, on a disk where equal areas are equal solid angles.

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"

namespace tsuya {

// Equal-area disk: radius sqrt(2) sin(theta/2), 1 at the horizon.
glm::dvec2 disk_of(double theta, double phi);

// The images of a point of the disk under the symmetry: the first `count`, the point first of all.
std::array<glm::dvec2, 4> images(double x, double y, Symmetry symmetry, int &count);

// Views that are one by the symmetry, in the order of the first of each group.
struct MirrorGroup {
    glm::dvec2 p;                     // of the disk
    std::vector<std::size_t> members; // indices of the views
};

std::vector<MirrorGroup> mirror_groups(const std::vector<BardView> &views, Symmetry symmetry);

} // namespace tsuya

#pragma once
// Pairs of light and view at which a model that is not careful gives no finite number.

#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "sdk/hemisphere_quadrature.h"

namespace tsuya::test {

// Unit, at a height of its own over the horizon.
glm::vec3 low(double z, double phi);

// Even, grazing, near the pole, near the mirror of the light, or nearly opposite to it.
std::pair<glm::vec3, glm::vec3> stressed_pair(Random &random);

// The corners: straight down, mirrored, both grazing, as near to opposite as it gets.
std::vector<std::pair<glm::vec3, glm::vec3>> directed_pairs();

} // namespace tsuya::test

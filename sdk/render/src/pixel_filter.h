#pragma once
// Where in the picture the samples of a pixel lie.

#include <glm/glm.hpp>

namespace tsuya {

// From a point of [0,1)^2 to a place about the middle of a pixel, pixels: a box of one pixel.
inline glm::vec2 filter_sample(glm::vec2 u) { return u - 0.5f; }

} // namespace tsuya

#pragma once
/// \file
/// Triangles for a triangle whose edges got further vertices.

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// Divides a polygon that is a triangle with further corners on its edges into triangles of no
/// vanishing area, the fattest ears first. \param polygon corners in the plane, counter-clockwise
/// \return triples of indices into `polygon`
std::vector<std::array<std::uint32_t, 3>> split_triangle(const std::vector<glm::dvec2> &polygon);

} // namespace tsuya::garment

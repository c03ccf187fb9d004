#pragma once
/// \file
/// Concave polygons as triangles.

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// True where a corner of a counter-clockwise polygon turns to the right by more than a quad, or
/// a larger face, of draped cloth does: subdivision would lay such a face over its own edge.
bool is_concave(const std::vector<glm::dvec2> &polygon);

/// Cuts a counter-clockwise polygon into triangles between its corners, the fattest ears first.
/// nullopt where it crosses itself. \return triples of indices into `polygon`
std::optional<std::vector<std::array<std::uint32_t, 3>>>
clip_ears(const std::vector<glm::dvec2> &polygon);

} // namespace tsuya::garment

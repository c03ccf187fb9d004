#pragma once
/// \file
/// Into how many pieces each edge and face of a control mesh is cut.

#include <vector>

#include "limit/limit_surface.h"

namespace tsuya::garment {

/// Numbers of pieces. An edge has one number for both of its faces, so that no crack can open.
struct TessellationRates {
    std::vector<int> edge{};         ///< per edge of the topology
    std::vector<glm::ivec2> inner{}; ///< per face, along its first and its second edge
};

/// Every edge and face alike.
TessellationRates uniform_rates(const LimitSurface &surface, int rate);

/// As many as the tolerance of `options` asks for; see SubdivideOptions.
TessellationRates adaptive_rates(const LimitSurface &surface, const SubdivideOptions &options);

} // namespace tsuya::garment

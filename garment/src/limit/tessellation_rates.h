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

/// What `options` ask for: uniform_rates of its level, or adaptive_rates. Throws Error where the
/// memory does not hold the surface, and Interrupted.
TessellationRates choose_rates(const LimitSurface &surface, const SubdivideOptions &options,
                               const Progress &progress);

/// As many as the tolerance of `options` asks for; see SubdivideOptions. Throws Interrupted.
TessellationRates adaptive_rates(const LimitSurface &surface, const SubdivideOptions &options,
                                 const Progress &progress);

} // namespace tsuya::garment

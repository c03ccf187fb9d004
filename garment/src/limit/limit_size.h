#pragma once
/// \file
/// How large a tessellation becomes, known before it is made.

#include "limit/tessellation_rates.h"

namespace tsuya::garment {

/// Counts of a surface. Exact for quads and triangles that are cut evenly, else near; vertices that
/// seams double are left out.
struct LimitSize {
    double points = 0, triangles = 0;

    /// The most bytes that are taken at one time until the surface is made.
    double bytes() const;
};

LimitSize limit_size(const LimitSurface &surface, const TessellationRates &rates);

/// Throws Error if the memory does not hold the surface: how many bytes are needed and available,
/// and which level would fit.
void need_room(const LimitSurface &surface, const TessellationRates &rates,
               const SubdivideOptions &options);

} // namespace tsuya::garment

#pragma once
/// \file
/// Tables that are smooth: quadratic B-splines, four places at once.

#include <cstddef>
#include <cstring>
#include <span>

#include "tsuya/sdk/detail/four_floats.h"

namespace tsuya {

/// Where four places lie in lines of coefficients that are 1 apart.
struct SplinePlaces {
    FourInts first;  ///< of the three coefficients about each
    FourFloats from; ///< the second of them, -0.5 to 0.5

    /// \param x place in a line, whose first coefficient is at -1
    /// \param last index of its last coefficient but two
    SplinePlaces(FourFloats x, FourFloats last)
        : first(whole_of(least(largest(x + 0.5f, four(0)), last))), from(x - floats_of(first)) {}
};

/// The spline between three neighbours, at `from` the second of them.
template <class Float, class From>
Float spline_between(Float below, Float at, Float above, From from) {
    const Float bend = 0.5f * (below + above) - at;
    return at + bend * (from * from + 0.25f) + 0.5f * (above - below) * from;
}

/// The same across three lines of a table, for four coefficients of each.
/// \param line the first of the first line
inline FourFloats spline_between_lines(const float *line, std::ptrdiff_t length, float from) {
    FourFloats below, at, above;
    std::memcpy(&below, line, sizeof below);
    std::memcpy(&at, line + length, sizeof at);
    std::memcpy(&above, line + 2 * length, sizeof above);
    return spline_between(below, at, above, four(from));
}

/// The splines along two such lines, each at its own place of the first two of `from`.
inline FourFloats spline_along_lines(FourFloats a, FourFloats b, FourFloats from) {
    const FourFloats below{a[0], b[0], 0, 0}, at{a[1], b[1], 0, 0}, above{a[2], b[2], 0, 0};
    return spline_between(below, at, above, from);
}

/// What is beyond an end of a line.
enum class SplineEnd {
    mirrored, ///< what is before it
    round,    ///< the other end, which has the same value
    smooth    ///< what keeps the third difference at 0
};

/// Turns values into the coefficients of the spline through them.
/// \param line values, with room for a coefficient beyond each end
void make_spline(std::span<double> line, SplineEnd first, SplineEnd last);

} // namespace tsuya

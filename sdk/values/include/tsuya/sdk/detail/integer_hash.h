#pragma once
/// \file
/// A hash of integers, from which random numbers that depend on their place alone are made.

#include <cstdint>

namespace tsuya::detail {

/// All bits of the result depend on all bits of x, which is mapped to one value alone. [Wellons]
/// lowbias32.
inline std::uint32_t hash(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

} // namespace tsuya::detail

#pragma once
/// \file
/// Four floats that are computed at once: the vector extension of GCC and Clang.

#include <cmath>
#include <cstdint>

namespace tsuya {

using FourFloats = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));

inline FourFloats four(float x) { return FourFloats{x, x, x, x}; }

/// The larger of each two; `b` where `a` is no number.
inline FourFloats largest(FourFloats a, FourFloats b) {
#if defined(__SSE2__)
    return __builtin_ia32_maxps(a, b);
#else
    return a > b ? a : b;
#endif
}

/// The smaller of each two; `b` where `a` is no number.
inline FourFloats least(FourFloats a, FourFloats b) {
#if defined(__SSE2__)
    return __builtin_ia32_minps(a, b);
#else
    return a < b ? a : b;
#endif
}

inline FourFloats root_of(FourFloats x) {
#if defined(__SSE2__)
    return __builtin_ia32_sqrtps(x);
#else
    return FourFloats{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

inline FourFloats size_of(FourFloats x) { return largest(x, -x); }

/// Cut towards 0.
inline FourInts whole_of(FourFloats x) { return __builtin_convertvector(x, FourInts); }
inline FourFloats floats_of(FourInts x) { return __builtin_convertvector(x, FourFloats); }

} // namespace tsuya

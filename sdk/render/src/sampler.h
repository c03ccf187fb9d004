#pragma once
// Random numbers that depend on pixel, sample index and purpose alone: padded two-dimensional Sobol
// points with hashed Owen scrambling and shuffling [Burley].

#include <cstdint>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/integer_hash.h"

namespace tsuya {

using detail::hash;

inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    return hash(a ^ (hash(b) + 0x9e3779b9u + (a << 6) + (a >> 2)));
}

inline std::uint32_t reverse_bits(std::uint32_t x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    return __builtin_bswap32(x);
}

// [Burley] the improved Laine-Karras permutation: each bit is flipped by a hash of those below it
inline std::uint32_t laine_karras(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

inline std::uint32_t nested_uniform_scramble(std::uint32_t x, std::uint32_t seed) {
    return reverse_bits(laine_karras(reverse_bits(x), seed));
}

// The second Sobol dimension: its generator matrix is Pascal's triangle modulo 2 [Joe], so that bit
// i of the result is the sum of the bits of the index at all supersets of i.
inline std::uint32_t sobol_second_reversed(std::uint32_t index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    index ^= (index >> 16) & 0x0000ffffu;
    return index;
}

inline float unit_float(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

// What a random number is used for, within one vertex of a path.
enum class Purpose : std::uint32_t {
    pixel,
    light_choice,
    light_point,
    lobe_and_strategy,
    direction,
    survival,
    hole,
    count
};

class Sampler {
  public:
    Sampler(std::uint32_t pixel_seed, std::uint32_t sample) : seed_(pixel_seed), sample_(sample) {}

    // A point of [0,1)^2 for a purpose at a vertex of the path.
    glm::vec2 pair(std::uint32_t vertex, Purpose purpose, std::uint32_t which = 0) const {
        const auto count = static_cast<std::uint32_t>(Purpose::count);
        const std::uint32_t key =
            hash(seed_, (which * 65536u + vertex) * count + static_cast<std::uint32_t>(purpose));
        // Shuffle the index, then scramble each dimension; both are Owen scramblings
        const std::uint32_t index = nested_uniform_scramble(sample_, key);
        const std::uint32_t x = laine_karras(index, hash(key, 1u));
        const std::uint32_t y = laine_karras(sobol_second_reversed(index), hash(key, 2u));
        return {unit_float(reverse_bits(x)), unit_float(reverse_bits(y))};
    }

  private:
    std::uint32_t seed_, sample_;
};

} // namespace tsuya

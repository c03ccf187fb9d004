#pragma once
// Random numbers that depend on pixel, sample index and purpose alone: at each vertex of a path a
// point of one joint Sobol sequence of ten dimensions, with hashed Owen scrambling and shuffling
// [Burley].

#include <cstdint>

#include <glm/glm.hpp>

#include "sobol.h"
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

inline float unit_float(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

// What two random numbers are used for, within one vertex of a path.
enum class Purpose : std::uint32_t {
    pixel,                // at the first vertex
    choice_and_survival = // at the others: which light, and whether the path goes on
    pixel,
    light_point,
    lobe_and_strategy,
    direction
};

class Sampler {
  public:
    Sampler(std::uint32_t pixel_seed, std::uint32_t sample) : seed_(pixel_seed), sample_(sample) {
        go_to(0);
    }

    std::uint32_t index() const { return sample_; }
    // The numbers are those of this vertex from now on. What one vertex uses is distributed
    // jointly; vertices are independent of each other.
    void go_to(std::uint32_t vertex) {
        key_ = hash(seed_, vertex);
        point_ = sobol_reversed(nested_uniform_scramble(sample_, key_));
    }

    // A point of [0,1)^2. \param which for what is done several times at a vertex: each is
    // distributed jointly with the other purposes, and sums over samples of one and of another are
    // uncorrelated
    glm::vec2 pair(Purpose purpose, std::uint32_t which = 0) const {
        const auto dimension = 2 * static_cast<std::uint32_t>(purpose);
        return scrambled(
            point_[dimension], point_[dimension + 1],
            hash(key_, dimension + static_cast<std::uint32_t>(kSobolDimensions) * which));
    }

    // The same, independent of all pairs and of each other: for what happens seldom.
    glm::vec2 lone_pair(std::uint32_t which) const {
        const std::uint32_t key = hash(~key_, which);
        const SobolPoint point = sobol_reversed(nested_uniform_scramble(sample_, key));
        return scrambled(point[0], point[1], key);
    }

    // Two more dimensions of the vertex's point, distributed jointly with its pairs: for what only
    // some scenes have.
    glm::vec2 further_pair() const {
        const FurtherSobolPoint point =
            further_sobol_reversed(nested_uniform_scramble(sample_, key_));
        return scrambled(point[0], point[1], hash(key_, 1u)); // pairs take even numbers
    }

  private:
    static glm::vec2 scrambled(std::uint32_t x, std::uint32_t y, std::uint32_t key) {
        return {unit_float(reverse_bits(laine_karras(x, hash(key, 1u)))),
                unit_float(reverse_bits(laine_karras(y, hash(key, 2u))))};
    }

    std::uint32_t seed_, sample_, key_ = 0;
    SobolPoint point_{};
};

} // namespace tsuya

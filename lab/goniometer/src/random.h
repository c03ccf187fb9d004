#pragma once
// Random numbers of one batch of photons.

#include <cmath>
#include <cstdint>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/integer_hash.h"

namespace tsuya::lab {

using detail::hash;

// [ONeill] PCG-XSH-RR with 64 bits of state; another stream for every seed.
class Random {
  public:
    Random(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        stream_ = (std::uint64_t{hash(a ^ hash(b))} << 32 | hash(c ^ 0x9e3779b9u)) | 1u;
        state_ = std::uint64_t{hash(hash(hash(a) + b) + c)} << 32 | hash(a + hash(b + hash(c)));
        bits();
    }

    std::uint32_t bits() {
        const std::uint64_t old = state_;
        state_ = old * 6364136223846793005ull + stream_;
        const auto shifted = static_cast<std::uint32_t>(((old >> 18) ^ old) >> 27);
        const auto turn = static_cast<std::uint32_t>(old >> 59);
        return shifted >> turn | shifted << ((32u - turn) & 31u);
    }
    float unit() { return static_cast<float>(bits() >> 8) * 0x1p-24f; }               // [0, 1)
    float open_unit() { return (static_cast<float>(bits() >> 9) + 0.5f) * 0x1p-23f; } // (0, 1)
    // Two independent standard normal numbers
    glm::vec2 normal() {
        const float radius = std::sqrt(-2 * std::log(open_unit()));
        const float angle = 2 * kPiF * unit();
        return {radius * std::cos(angle), radius * std::sin(angle)};
    }

  private:
    std::uint64_t state_, stream_;
};

} // namespace tsuya::lab

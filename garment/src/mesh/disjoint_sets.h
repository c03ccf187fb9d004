#pragma once
/// \file
/// Disjoint sets of numbers: union and find.

#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

namespace tsuya::garment {

/// A number for each member, and how many numbers there are.
struct SetNumbers {
    std::vector<std::uint32_t> of{};
    std::uint32_t count = 0;
};

/// The numbers 0 to size - 1, at first each a set of its own.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t size) : parent_(size) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    /// Root of the set of `i`: its smallest member. Path halving.
    std::uint32_t find(std::uint32_t i) {
        while (parent_[i] != i)
            i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    /// Unites two sets under the smaller root.
    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a);
        b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }
    /// Numbers the sets 0, 1, ... in the order of their first members.
    SetNumbers number() {
        constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> of_root(parent_.size(), kNone);
        SetNumbers result{.of = std::vector<std::uint32_t>(parent_.size())};
        for (std::uint32_t i = 0; i < parent_.size(); ++i) {
            std::uint32_t &n = of_root[find(i)];
            if (n == kNone)
                n = result.count++;
            result.of[i] = n;
        }
        return result;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

} // namespace tsuya::garment

#pragma once
/// \file
/// Finds things near a point: a hash of cubic cells.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// Holds item numbers by the cells that their boxes touch. Coordinates are counted from `origin`.
class PlaceGrid {
  public:
    /// \param fill gets a function of item, lower and upper corner of a box, to be called with
    /// ascending items; one item may have several boxes
    template <typename Fill>
    PlaceGrid(const glm::dvec3 &origin, double cell, Fill &&fill) : origin_(origin), cell_(cell) {
        struct Entry {
            std::uint32_t hash, item;
        };
        std::vector<Entry> entries;
        fill([&](std::uint32_t item, const glm::dvec3 &lower, const glm::dvec3 &upper) {
            const glm::i64vec3 a = cell_of(lower), b = cell_of(upper);
            for (std::int64_t z = a.z; z <= b.z; ++z)
                for (std::int64_t y = a.y; y <= b.y; ++y)
                    for (std::int64_t x = a.x; x <= b.x; ++x)
                        entries.push_back({hash_of({x, y, z}), item});
        });
        // A counting sort by the hash, in which the items of a cell stay in their order.
        start_.resize(std::bit_ceil(entries.size() + 1) + 1);
        const auto slot = [&](const Entry &e) { return e.hash & (start_.size() - 2); };
        for (const Entry &e : entries)
            ++start_[slot(e) + 1];
        for (std::size_t i = 1; i < start_.size(); ++i)
            start_[i] += start_[i - 1];
        items_.resize(entries.size());
        std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
        for (const Entry &e : entries)
            items_[next[slot(e)]++] = e.item;
    }

    /// Items whose boxes touch the cell of `p`, ascending, some more than once; cells that share a
    /// hash may add others.
    std::span<const std::uint32_t> at(const glm::dvec3 &p) const {
        const std::size_t slot = hash_of(cell_of(p)) & (start_.size() - 2);
        return {items_.data() + start_[slot], items_.data() + start_[slot + 1]};
    }

  private:
    glm::i64vec3 cell_of(const glm::dvec3 &p) const {
        constexpr double kFarthest = 1e15; // cells; what is farther shares the last
        return glm::i64vec3(glm::floor(glm::clamp((p - origin_) / cell_, -kFarthest, kFarthest)));
    }
    static std::uint32_t hash_of(const glm::i64vec3 &c) {
        std::uint64_t hash = 0;
        for (int i = 0; i < 3; ++i)
            hash = std::rotl(hash ^ static_cast<std::uint64_t>(c[i]), 23) * 0x9e3779b97f4a7c15u;
        return static_cast<std::uint32_t>(hash >> 32);
    }

    glm::dvec3 origin_;
    double cell_;
    std::vector<std::uint32_t> start_, items_;
};

} // namespace tsuya::garment

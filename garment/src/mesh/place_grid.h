#pragma once
/// \file
/// Finds things near a point: a hash of cubic cells.

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/glm.hpp>

namespace tsuya::garment {

/// Holds item numbers by the cells that their boxes touch. Coordinates are counted from `origin`.
class PlaceGrid {
  public:
    PlaceGrid(const glm::dvec3 &origin, double cell) : origin_(origin), cell_(cell) {}

    /// Puts an item into every cell that its box touches.
    void insert(std::uint32_t item, const glm::dvec3 &lower, const glm::dvec3 &upper) {
        const glm::i64vec3 a = cell_of(lower), b = cell_of(upper);
        for (std::int64_t z = a.z; z <= b.z; ++z)
            for (std::int64_t y = a.y; y <= b.y; ++y)
                for (std::int64_t x = a.x; x <= b.x; ++x)
                    cells_[key({x, y, z})].push_back(item);
    }

    /// Items whose boxes touch the cell of `p`; cells that share a key may add others.
    const std::vector<std::uint32_t> &at(const glm::dvec3 &p) const {
        static const std::vector<std::uint32_t> kEmpty;
        const auto it = cells_.find(key(cell_of(p)));
        return it == cells_.end() ? kEmpty : it->second;
    }

  private:
    glm::i64vec3 cell_of(const glm::dvec3 &p) const {
        constexpr double kFarthest = 1e15; // cells; what is farther shares the last
        return glm::i64vec3(glm::floor(glm::clamp((p - origin_) / cell_, -kFarthest, kFarthest)));
    }
    static std::uint64_t key(const glm::i64vec3 &c) {
        // 21 bits a coordinate; far cells may share a key, which costs time alone.
        constexpr std::uint64_t kMask = (1u << 21) - 1;
        return (static_cast<std::uint64_t>(c.x) & kMask) |
               (static_cast<std::uint64_t>(c.y) & kMask) << 21 |
               (static_cast<std::uint64_t>(c.z) & kMask) << 42;
    }

    glm::dvec3 origin_;
    double cell_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

} // namespace tsuya::garment

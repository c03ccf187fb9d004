#pragma once
/// \file
/// Which parts of a garment lie on each other as layers of cloth, and so are not sewn together.

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "repair/rims.h"

namespace tsuya::garment {

/// Pairs of parts that are layers, and the part of each vertex.
class LayeredParts {
  public:
    LayeredParts() = default;
    LayeredParts(std::vector<std::uint32_t> part,
                 std::set<std::pair<std::uint32_t, std::uint32_t>> pairs)
        : part_(std::move(part)), pairs_(std::move(pairs)) {
        for (const auto &[a, b] : pairs_)
            layered_.insert({a, b});
    }

    /// Two vertices are of layers; false for vertices that sewing added.
    bool has(std::uint32_t a, std::uint32_t b) const {
        return !pairs_.empty() && a < part_.size() && b < part_.size() &&
               pairs_.contains(std::minmax(part_[a], part_[b]));
    }
    /// The vertex is of a part that is a layer of another.
    bool has_any(std::uint32_t v) const {
        return !layered_.empty() && v < part_.size() && layered_.contains(part_[v]);
    }

  private:
    std::vector<std::uint32_t> part_{};
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_{};
    std::set<std::uint32_t> layered_{};
};

/// Votes of the places where rims of two parts meet. A seam may have spots where cloth folds over,
/// and two panels of a bag lie on each other along their whole seam: so parts whose contact is
/// nearly all folded may be layers, and are if their faces lie on each other, too.
class LayerVotes {
  public:
    /// Of different parts.
    void add(std::uint32_t part, std::uint32_t other, Contact contact) {
        if (contact == Contact::none)
            return;
        auto &[folded, all] = votes_[std::minmax(part, other)];
        folded += contact == Contact::folded;
        ++all;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> candidates() const {
        constexpr std::size_t kShare = 10; // at most one in so many may be a seam
        std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
        for (const auto &[pair, votes] : votes_)
            if (kShare * (votes.second - votes.first) <= votes.second)
                pairs.push_back(pair);
        return pairs;
    }

  private:
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::pair<std::size_t, std::size_t>> votes_{};
};

/// Most of the smaller set of faces lies within a distance of the other: of up to 64 of its faces.
bool lie_on_each_other(const PolygonMesh &mesh, std::vector<std::uint32_t> faces,
                       std::vector<std::uint32_t> others, double distance);

} // namespace tsuya::garment

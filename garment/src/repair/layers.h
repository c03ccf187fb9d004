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

/// Pairs of parts that are layers, and the parts of each vertex: more than one where vertices of
/// several parts were joined.
class LayeredParts {
  public:
    LayeredParts() = default;
    LayeredParts(const std::vector<std::uint32_t> &part, std::uint32_t parts,
                 std::set<std::pair<std::uint32_t, std::uint32_t>> pairs);

    /// Two vertices are of layers; false for vertices that sewing added.
    bool has(std::uint32_t a, std::uint32_t b) const;

    // The same of vertices that change. Does nothing where there are no layers.
    /// The members of a cluster become `into`.
    void join(std::uint32_t into, const std::vector<std::uint32_t> &members);
    /// Vertex `kept[i]` becomes vertex i.
    void keep(const std::vector<std::uint32_t> &kept);
    /// There is a new vertex that is a copy.
    void copy(std::uint32_t vertex, std::uint32_t added);

  private:
    std::uint32_t set_of(std::uint32_t v) const { return v < set_.size() ? set_[v] : 0; }

    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs_{};
    std::vector<std::vector<std::uint32_t>> sets_{}; ///< of parts; the first is empty
    std::vector<std::uint32_t> set_{};               ///< of each vertex
};

/// Votes of the places where rims of two parts meet. A seam may have spots where cloth folds over,
/// and two panels of a bag lie on each other along their whole seam: so parts whose contact is
/// nearly all folded may be layers, and are if their faces lie on each other, too.
class LayerVotes {
  public:
    using Parts = std::pair<std::uint32_t, std::uint32_t>;

    /// \param vertex of one part, near the rim of the other
    void add(Parts parts, std::uint32_t vertex, Contact contact) {
        if (contact == Contact::none)
            return;
        Votes &votes = votes_[std::minmax(parts.first, parts.second)];
        ++votes.all;
        if (contact == Contact::folded)
            votes.folded.push_back(vertex);
    }
    std::vector<Parts> candidates() const {
        constexpr std::size_t kShare = 10; // at most one in so many may be a seam
        std::vector<Parts> pairs;
        for (const auto &[pair, votes] : votes_)
            if (kShare * (votes.all - votes.folded.size()) <= votes.all)
                pairs.push_back(pair);
        return pairs;
    }
    /// The vertices where parts lie on each other.
    const std::vector<std::uint32_t> &folded(const Parts &parts) const {
        return votes_.at(parts).folded;
    }

  private:
    struct Votes {
        std::vector<std::uint32_t> folded{};
        std::size_t all = 0;
    };
    std::map<Parts, Votes> votes_{};
};

/// Most of the smaller set of faces lies within a distance of the other: of up to 64 of its faces.
bool lie_on_each_other(const PolygonMesh &mesh, std::vector<std::uint32_t> faces,
                       std::vector<std::uint32_t> others, double distance);

} // namespace tsuya::garment

#include "repair/pairing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "mesh/disjoint_sets.h"
#include "mesh/stop.h"

namespace tsuya::garment {
namespace {

/// A vertex is put into an edge only this far from its ends, as a share of the edge, and farther
/// than the tolerance or the second share: a vertex nearer to an end is that end's affair.
constexpr double kInnerShare = 0.02;
constexpr double kEndShare = 0.1;

/// Bounds on the work where very many vertices lie at one place: candidates that are looked at for
/// a vertex, the nearest of them that are tried, and vertices that become one.
constexpr std::size_t kMostScanned = 4096, kMostTried = 32, kMostMembers = 64;

/// Numbers of vertices in the list of those of the boundary.
struct Pair {
    double distance;
    std::uint32_t a, b;
    bool operator<(const Pair &q) const {
        return std::tie(distance, a, b) < std::tie(q.distance, q.a, q.b);
    }
};

void sort(std::vector<Insertion> &insertions) {
    std::sort(insertions.begin(), insertions.end(), [](const Insertion &a, const Insertion &b) {
        return std::tie(a.corner, a.t, a.vertex) < std::tie(b.corner, b.t, b.vertex);
    });
    // Two vertices at one place of an edge would make an edge of no length: the second waits.
    const auto last = std::unique(insertions.begin(), insertions.end(),
                                  [](const Insertion &a, const Insertion &b) {
                                      return a.corner == b.corner && b.t - a.t < kInnerShare;
                                  });
    insertions.erase(last, insertions.end());
}

class PairFinder {
  public:
    PairFinder(const PolygonMesh &mesh, const OpenSides &sides, const PairingRules &rules)
        : mesh_(mesh), sides_(sides), vertices_(sides.vertices()), rules_(rules) {}

    Pairing find(const Progress &progress) {
        Pairing found;
        if (rules_.join_vertices)
            join(progress, found);
        // Where a vertex lies on an edge shows when vertices are joined.
        if (!found.clusters.empty())
            return found;
        std::size_t turn = 0;
        for (const std::uint32_t v : vertices_) {
            look_at_stop(progress, turn++);
            if (!rules_.allowed.has(v))
                continue;
            if (const auto insertion = nearest_side(v))
                found.insertions.push_back(*insertion);
        }
        sort(found.insertions);
        return found;
    }

  private:
    const glm::dvec3 &place(std::uint32_t a) const { return mesh_.position[vertices_[a]]; }
    std::uint32_t number_of(std::uint32_t v) const {
        return static_cast<std::uint32_t>(std::lower_bound(vertices_.begin(), vertices_.end(), v) -
                                          vertices_.begin());
    }

    /// Faces of each vertex of the boundary, and how far it may be joined.
    void look_around() {
        constexpr std::uint32_t kInside = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> number(mesh_.position.size(), kInside);
        for (std::uint32_t a = 0; a < vertices_.size(); ++a)
            number[vertices_[a]] = a;
        faces_.resize(vertices_.size());
        reach_.assign(vertices_.size(), rules_.tolerance);
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
            for (std::uint32_t c = mesh_.face_offset[f]; c < mesh_.face_offset[f + 1]; ++c) {
                const std::uint32_t a = number[mesh_.corner_position[c]];
                if (a == kInside)
                    continue;
                faces_[a].push_back(f);
                for (const std::uint32_t end : {mesh_.next(f, c), mesh_.previous(f, c)})
                    reach_[a] = std::min(
                        reach_[a],
                        kEdgeShare *
                            glm::distance(place(a), mesh_.position[mesh_.corner_position[end]]));
            }
    }

    /// Pairs with vertices that come after `a`: those where the sides about it start.
    void add_pairs(std::uint32_t a, std::vector<Pair> &pairs) {
        const std::span<const std::uint32_t> near = sides_.near(place(a));
        const auto before = [&](std::uint32_t v, std::uint32_t side) {
            return v < sides_.sides()[side].from;
        };
        auto it = std::upper_bound(near.begin(), near.end(), vertices_[a], before);
        own_.clear();
        for (std::size_t n = 0; it != near.end() && n < kMostScanned; ++it, ++n) {
            const std::uint32_t v = sides_.sides()[*it].from;
            const double d = glm::distance(place(a), mesh_.position[v]);
            if (!(d <= reach_[a]) || !rules_.allowed.has(v) || rules_.layers.has(vertices_[a], v))
                continue;
            const std::uint32_t b = number_of(v);
            if (d <= reach_[b] && (own_.empty() || own_.back().b != b))
                own_.push_back({d, a, b});
        }
        if (own_.size() > kMostTried) {
            std::nth_element(own_.begin(), own_.begin() + kMostTried, own_.end());
            own_.resize(kMostTried);
        }
        pairs.insert(pairs.end(), own_.begin(), own_.end());
    }

    /// The nearest side that `v` lies on but does not touch.
    std::optional<Insertion> nearest_side(std::uint32_t v) const {
        std::optional<Insertion> best;
        const glm::dvec3 p = mesh_.position[v];
        for (const std::uint32_t i : sides_.near(p)) {
            const OpenSide &s = sides_.sides()[i];
            const glm::dvec3 a = sides_.start(s), b = sides_.end(s);
            const double length2 = glm::dot(b - a, b - a);
            const double t = length2 > 0.0 ? glm::dot(p - a, b - a) / length2 : 0.0;
            if (t < kInnerShare || t > 1.0 - kInnerShare)
                continue;
            const double distance = glm::distance(p, a + t * (b - a)), length = std::sqrt(length2);
            const double room = std::min(rules_.tolerance, kEndShare * length);
            if (distance > std::min(rules_.tolerance, kEdgeShare * length) ||
                (best && distance >= best->distance) ||
                std::min(glm::distance(p, a), glm::distance(p, b)) <= room)
                continue;
            if (rules_.allowed.has(s.from) && rules_.allowed.has(s.to) && !sides_.face_has(s, v) &&
                !rules_.layers.has(v, s.from))
                best = Insertion{s.corner, t, v, distance};
        }
        return best;
    }

    /// Makes clusters of pairs.
    void join(const Progress &progress, Pairing &found) {
        look_around();
        std::vector<Pair> pairs;
        for (std::uint32_t a = 0; a < vertices_.size(); ++a) {
            look_at_stop(progress, a);
            if (rules_.allowed.has(vertices_[a]))
                add_pairs(a, pairs);
        }
        std::sort(pairs.begin(), pairs.end());
        DisjointSets sets(vertices_.size());
        std::vector<std::vector<std::uint32_t>> members(vertices_.size());
        for (std::uint32_t a = 0; a < members.size(); ++a)
            members[a] = {a};
        std::size_t turn = 0;
        for (const Pair &pair : pairs) {
            look_at_stop(progress, turn++);
            const auto [a, b] = std::minmax({sets.find(pair.a), sets.find(pair.b)});
            if (a == b || members[a].size() + members[b].size() > kMostMembers)
                continue;
            double widest = 0.0;
            bool layers = false;
            for (const std::uint32_t m : members[a])
                for (const std::uint32_t n : members[b]) {
                    widest = std::max(widest, glm::distance(place(m), place(n)));
                    layers = layers || rules_.layers.has(vertices_[m], vertices_[n]);
                }
            if (widest > rules_.tolerance || layers || have_common(faces_[a], faces_[b]))
                continue;
            sets.unite(a, b);
            members[a].insert(members[a].end(), members[b].begin(), members[b].end());
            faces_[a].insert(faces_[a].end(), faces_[b].begin(), faces_[b].end());
            found.largest_gap = std::max(found.largest_gap, widest);
        }
        for (std::uint32_t a = 0; a < members.size(); ++a)
            if (sets.find(a) == a && members[a].size() > 1) {
                std::vector<std::uint32_t> &cluster = found.clusters.emplace_back();
                for (const std::uint32_t m : members[a])
                    cluster.push_back(vertices_[m]);
            }
    }

    static bool have_common(const std::vector<std::uint32_t> &a,
                            const std::vector<std::uint32_t> &b) {
        return std::find_first_of(a.begin(), a.end(), b.begin(), b.end()) != a.end();
    }

    const PolygonMesh &mesh_;
    const OpenSides &sides_;
    const std::vector<std::uint32_t> &vertices_;
    const PairingRules &rules_;
    std::vector<std::vector<std::uint32_t>> faces_{};
    std::vector<double> reach_{};
    std::vector<Pair> own_{};
};

} // namespace

Pairing pair_sides(const PolygonMesh &mesh, const OpenSides &sides, const PairingRules &rules,
                   const Progress &progress) {
    return PairFinder(mesh, sides, rules).find(progress);
}

} // namespace tsuya::garment

// Boundary vertices that lie at one place become one vertex.

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/disjoint_sets.h"
#include "mesh/place_grid.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

/// Bounds on the work where very many vertices lie at one place: candidates that are looked at for
/// a vertex, the nearest of them that are tried, and vertices that become one.
constexpr std::size_t kMostScanned = 4096, kMostTried = 32, kMostMembers = 64;

struct Pair {
    double distance;
    std::uint32_t a, b;
    bool operator<(const Pair &q) const {
        return std::tie(distance, a, b) < std::tie(q.distance, q.a, q.b);
    }
};

/// Clusters of boundary vertices that become one vertex.
class VertexJoiner {
  public:
    VertexJoiner(const PolygonMesh &mesh, const HalfEdgeMesh &half_edges, double tolerance,
                 const VertexSet &allowed, const LayeredParts &layers)
        : mesh_(mesh), layers_(layers), tolerance_(tolerance), cluster_(mesh.position.size()),
          members_(mesh.position.size()), faces_(mesh.position.size()) {
        for (const auto v : half_edges.vertices())
            if (half_edges.is_boundary(v) && allowed.has(static_cast<std::uint32_t>(v.idx())))
                add_boundary_vertex(half_edges, v);
    }

    /// Joins what is near. Throws Interrupted.
    void join(const Progress &progress) {
        std::size_t turn = 0;
        for (const Pair &p : near_pairs(progress)) {
            look_at_stop(progress, turn++);
            join_pair(p.a, p.b);
        }
    }

    std::size_t joined() const { return joined_; }
    double largest_gap() const { return largest_gap_; }
    /// The vertex that stands for the cluster of `v`.
    std::uint32_t vertex_of(std::uint32_t v) { return cluster_.find(v); }

    /// Calls `visit(vertex, members)` for each cluster of more than one.
    template <typename Visit> void for_each_cluster(Visit &&visit) {
        for (const std::uint32_t v : boundary_)
            if (cluster_.find(v) == v && members_[v].size() > 1)
                visit(v, members_[v]);
    }

  private:
    void add_boundary_vertex(const HalfEdgeMesh &half_edges, HalfEdgeMesh::VertexHandle handle) {
        const auto v = static_cast<std::uint32_t>(handle.idx());
        double shortest = std::numeric_limits<double>::max();
        for (const auto other : half_edges.vv_range(handle))
            shortest = std::min(
                shortest, glm::distance(mesh_.position[v],
                                        mesh_.position[static_cast<std::size_t>(other.idx())]));
        for (const auto face : half_edges.vf_range(handle))
            faces_[v].push_back(static_cast<std::uint32_t>(face.idx()));
        boundary_.push_back(v);
        members_[v] = {v};
        reach_.resize(mesh_.position.size(), 0.0);
        reach_[v] = std::min(tolerance_, kEdgeShare * shortest);
        widest_reach_ = std::max(widest_reach_, reach_[v]);
    }

    std::vector<Pair> near_pairs(const Progress &progress) const {
        std::vector<Pair> pairs, own;
        PlaceGrid grid(bounds(mesh_).lower, std::max(2.0 * widest_reach_, 1e-300));
        for (const std::uint32_t v : boundary_)
            grid.insert(v, mesh_.position[v] - widest_reach_, mesh_.position[v] + widest_reach_);
        std::size_t turn = 0;
        for (const std::uint32_t a : boundary_) {
            look_at_stop(progress, turn++);
            // The items of a cell are in ascending order.
            const std::vector<std::uint32_t> &near = grid.at(mesh_.position[a]);
            auto it = std::upper_bound(near.begin(), near.end(), a);
            own.clear();
            for (std::size_t n = 0; it != near.end() && n < kMostScanned; ++it, ++n) {
                const double d = glm::distance(mesh_.position[a], mesh_.position[*it]);
                if (d <= std::min(reach_[a], reach_[*it]) && !layers_.has(a, *it) &&
                    (own.empty() || own.back().b != *it))
                    own.push_back({d, a, *it});
            }
            if (own.size() > kMostTried) {
                std::nth_element(own.begin(), own.begin() + kMostTried, own.end());
                own.resize(kMostTried);
            }
            pairs.insert(pairs.end(), own.begin(), own.end());
        }
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

    void join_pair(std::uint32_t a, std::uint32_t b) {
        a = cluster_.find(a);
        b = cluster_.find(b);
        if (a == b || members_[a].size() + members_[b].size() > kMostMembers)
            return;
        double widest = 0.0;
        for (const std::uint32_t m : members_[a])
            for (const std::uint32_t n : members_[b])
                widest = std::max(widest, glm::distance(mesh_.position[m], mesh_.position[n]));
        if (widest > tolerance_)
            return;
        for (const std::uint32_t f : faces_[a])
            if (std::find(faces_[b].begin(), faces_[b].end(), f) != faces_[b].end())
                return;
        if (b < a)
            std::swap(a, b);
        cluster_.unite(a, b);
        members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
        faces_[a].insert(faces_[a].end(), faces_[b].begin(), faces_[b].end());
        ++joined_;
        largest_gap_ = std::max(largest_gap_, widest);
    }

    const PolygonMesh &mesh_;
    const LayeredParts &layers_;
    double tolerance_, widest_reach_ = 0.0, largest_gap_ = 0.0;
    std::size_t joined_ = 0;
    DisjointSets cluster_;
    std::vector<std::vector<std::uint32_t>> members_, faces_;
    std::vector<std::uint32_t> boundary_;
    std::vector<double> reach_; ///< how far a vertex may be joined
};

} // namespace

void MeshRepair::join_vertices(double tolerance, const VertexSet &allowed) {
    VertexJoiner joiner(mesh_, half_edges(), tolerance, allowed, layers_);
    joiner.join(progress_);
    if (joiner.joined() == 0)
        return;
    report_.seams.joined += joiner.joined();
    report_.seams.largest_gap = std::max(report_.seams.largest_gap, joiner.largest_gap());
    joiner.for_each_cluster([&](std::uint32_t v, const std::vector<std::uint32_t> &members) {
        recipe_.mean(mesh_.position, v, members);
    });
    for (std::uint32_t &v : mesh_.corner_position)
        v = joiner.vertex_of(v);
    faces_changed();
}

std::size_t MeshRepair::collapse_short_edges(double tolerance, const VertexSet &allowed) {
    // Every vertex takes part in one collapse at most, so that none moves far.
    std::vector<std::uint32_t> into(mesh_.position.size());
    std::iota(into.begin(), into.end(), 0u);
    std::vector<bool> used(mesh_.position.size(), false);
    std::size_t count = 0;
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        const std::uint32_t a = uses[0].low, b = uses[0].high;
        if (!allowed.has(a) || !allowed.has(b) || used[a] || used[b] ||
            glm::distance(mesh_.position[a], mesh_.position[b]) > tolerance)
            return;
        used[a] = used[b] = true;
        into[b] = a;
        recipe_.mean(mesh_.position, a, {a, b});
        ++count;
    });
    if (count == 0)
        return 0;
    for (std::uint32_t &v : mesh_.corner_position)
        v = into[v];
    faces_changed();
    return count;
}

} // namespace tsuya::garment

#include "repair/vertex_joiner.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "mesh/edges.h"
#include "mesh/place_grid.h"
#include "repair/topology.h"

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
    VertexJoiner(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed)
        : mesh_(mesh), tolerance_(tolerance), parent_(mesh.position.size()),
          members_(mesh.position.size()), faces_(mesh.position.size()) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        const HalfEdgeMesh half_edges = make_half_edges(mesh);
        for (const auto v : half_edges.vertices())
            if (half_edges.is_boundary(v) && allowed.has(static_cast<std::uint32_t>(v.idx())))
                add_boundary_vertex(half_edges, v);
    }

    void join(SeamReport &report) {
        for (const Pair &p : near_pairs())
            join_pair(p.a, p.b, report);
    }

    /// The mesh with every cluster at the mean of its members.
    PolygonMesh result(PositionRecipe &recipe) {
        PolygonMesh out = mesh_;
        for (const std::uint32_t v : boundary_)
            if (find_set(parent_, v) == v && members_[v].size() > 1)
                recipe.mean(out.position, v, members_[v]);
        for (std::uint32_t &v : out.corner_position)
            v = find_set(parent_, v);
        return out;
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

    std::vector<Pair> near_pairs() const {
        std::vector<Pair> pairs, own;
        PlaceGrid grid(bounds(mesh_).lower, std::max(2.0 * widest_reach_, 1e-300));
        for (const std::uint32_t v : boundary_)
            grid.insert(v, mesh_.position[v] - widest_reach_, mesh_.position[v] + widest_reach_);
        for (const std::uint32_t a : boundary_) {
            // The items of a cell are in ascending order.
            const std::vector<std::uint32_t> &near = grid.at(mesh_.position[a]);
            auto it = std::upper_bound(near.begin(), near.end(), a);
            own.clear();
            for (std::size_t n = 0; it != near.end() && n < kMostScanned; ++it, ++n) {
                const double d = glm::distance(mesh_.position[a], mesh_.position[*it]);
                if (d <= std::min(reach_[a], reach_[*it]) && (own.empty() || own.back().b != *it))
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

    void join_pair(std::uint32_t a, std::uint32_t b, SeamReport &report) {
        a = find_set(parent_, a);
        b = find_set(parent_, b);
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
        parent_[b] = a;
        members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
        faces_[a].insert(faces_[a].end(), faces_[b].begin(), faces_[b].end());
        ++report.joined;
        report.largest_gap = std::max(report.largest_gap, widest);
    }

    const PolygonMesh &mesh_;
    double tolerance_, widest_reach_ = 0.0;
    std::vector<std::uint32_t> parent_;
    std::vector<std::vector<std::uint32_t>> members_, faces_;
    std::vector<std::uint32_t> boundary_;
    std::vector<double> reach_; ///< how far a vertex may be joined
};

} // namespace

Box bounds(const PolygonMesh &mesh) {
    Box box;
    for (const glm::dvec3 &p : mesh.position) {
        box.lower = glm::min(box.lower, p);
        box.upper = glm::max(box.upper, p);
    }
    return box;
}

PolygonMesh join_vertices(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                          PositionRecipe &recipe, SeamReport &report) {
    VertexJoiner joiner(mesh, tolerance, allowed);
    joiner.join(report);
    return joiner.result(recipe);
}

std::size_t collapse_short_edges(PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                                 PositionRecipe &recipe) {
    // Every vertex takes part in one collapse at most, so that none moves far.
    std::vector<std::uint32_t> into(mesh.position.size());
    std::iota(into.begin(), into.end(), 0u);
    std::vector<bool> used(mesh.position.size(), false);
    std::size_t count = 0;
    EdgeTable(mesh).for_each_edge([&](std::span<const EdgeUse> uses) {
        const std::uint32_t a = uses[0].low, b = uses[0].high;
        if (!allowed.has(a) || !allowed.has(b) || used[a] || used[b] ||
            glm::distance(mesh.position[a], mesh.position[b]) > tolerance)
            return;
        used[a] = used[b] = true;
        into[b] = a;
        recipe.mean(mesh.position, a, {a, b});
        ++count;
    });
    for (std::uint32_t &v : mesh.corner_position)
        v = into[v];
    return count;
}

} // namespace tsuya::garment

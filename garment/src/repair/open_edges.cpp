// Edges that only one face has, by place, and vertices that lie on them.

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unordered_map>

#include "mesh/disjoint_sets.h"
#include "mesh/distance.h"
#include "mesh/place_grid.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"
#include "repair/rims.h"

namespace tsuya::garment {
namespace {

/// A vertex is put into an edge only this far from its ends, as a share of the edge, and farther
/// than the tolerance or the second share: a vertex nearer to an end is that end's affair.
constexpr double kInnerShare = 0.02;
constexpr double kEndShare = 0.1;

/// How far layers of cloth may lie from each other, in tolerances of sewing.
constexpr double kLayerTolerances = 4.0;

/// Sides of edges between `allowed` vertices that only one face has.
std::vector<EdgeUse> open_edges(const EdgeTable &edges, const VertexSet &allowed) {
    std::vector<EdgeUse> open;
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() == 1 && allowed.has(uses[0].low) && allowed.has(uses[0].high))
            open.push_back(uses[0]);
    });
    return open;
}

/// Their ends, ascending.
std::vector<std::uint32_t> ends_of(const std::vector<EdgeUse> &edges) {
    std::vector<std::uint32_t> ends;
    for (const EdgeUse &e : edges) {
        ends.push_back(e.low);
        ends.push_back(e.high);
    }
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    return ends;
}

/// Open edges by place.
class OpenEdges {
  public:
    OpenEdges(const PolygonMesh &mesh, std::vector<EdgeUse> edges, double tolerance,
              const LayeredParts &layers)
        : mesh_(mesh), layers_(layers), tolerance_(tolerance), edges_(std::move(edges)),
          cell_(cell_size()), grid_(bounds(mesh).lower, cell_) {
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            // In pieces of a cell's size: the box of a long edge would hold very many cells.
            const glm::dvec3 a = mesh.position[edges_[i].low], b = mesh.position[edges_[i].high];
            const double pieces = std::max(1.0, std::ceil(glm::distance(a, b) / cell_));
            for (double k = 0.0; k < pieces; ++k) {
                const glm::dvec3 p = a + k / pieces * (b - a), q = a + (k + 1.0) / pieces * (b - a);
                grid_.insert(i, glm::min(p, q) - tolerance, glm::max(p, q) + tolerance);
            }
        }
    }

    const std::vector<EdgeUse> &edges() const { return edges_; }

    /// The nearest open edge that `v` lies on but does not touch.
    std::optional<Insertion> nearest(std::uint32_t v) const {
        std::optional<Insertion> best;
        const glm::dvec3 p = mesh_.position[v];
        for (const std::uint32_t i : grid_.at(p)) {
            const EdgeUse &e = edges_[i];
            if (face_has(e.face, v) || layers_.has(v, e.low))
                continue;
            const glm::dvec3 a = mesh_.position[mesh_.corner_position[e.corner]];
            const glm::dvec3 b =
                mesh_.position[mesh_.corner_position[mesh_.next(e.face, e.corner)]];
            const double length2 = glm::dot(b - a, b - a);
            const double t = length2 > 0.0 ? glm::dot(p - a, b - a) / length2 : 0.0;
            const double room = std::min(tolerance_, kEndShare * std::sqrt(length2));
            if (t < kInnerShare || t > 1.0 - kInnerShare ||
                std::min(glm::distance(p, a), glm::distance(p, b)) <= room)
                continue;
            const double distance = glm::distance(p, a + t * (b - a));
            const double reach = std::min(tolerance_, kEdgeShare * std::sqrt(length2));
            if (distance <= reach && (!best || distance < best->distance))
                best = Insertion{e.corner, t, v, distance};
        }
        return best;
    }

    /// Votes of a vertex for each part whose rim it lies on, but its own face's.
    void vote(std::uint32_t v, const std::vector<RimEdge> &rims,
              const std::vector<std::uint32_t> &part, LayerVotes &votes) const {
        const glm::dvec3 p = mesh_.position[v];
        for (const std::uint32_t i : grid_.at(p)) {
            const EdgeUse &e = edges_[i];
            const glm::dvec3 a = mesh_.position[mesh_.corner_position[e.corner]];
            const glm::dvec3 b =
                mesh_.position[mesh_.corner_position[mesh_.next(e.face, e.corner)]];
            if (e.low == v || e.high == v || face_has(e.face, v) ||
                segment_distance(p, a, b) > tolerance_)
                continue;
            // As it is seen from the vertex: from an end, or from between
            std::vector<RimEdge> seen;
            if (glm::distance(p, b) > tolerance_)
                seen.push_back(rim_edge(mesh_, e.face, e.corner, true));
            if (glm::distance(p, a) > tolerance_)
                seen.push_back(rim_edge(mesh_, e.face, e.corner, false));
            votes.add(part[v], part[e.low], contact_of(rims, seen));
        }
    }

  private:
    double cell_size() const {
        double sum = 0.0;
        for (const EdgeUse &e : edges_)
            sum += glm::distance(mesh_.position[e.low], mesh_.position[e.high]);
        const double mean = edges_.empty() ? 1.0 : sum / static_cast<double>(edges_.size());
        return std::max({mean, 2.0 * tolerance_, 1e-300});
    }
    bool face_has(std::size_t f, std::uint32_t v) const {
        const auto first = mesh_.corner_position.begin();
        return std::find(first + mesh_.face_offset[f], first + mesh_.face_offset[f + 1], v) !=
               first + mesh_.face_offset[f + 1];
    }

    const PolygonMesh &mesh_;
    const LayeredParts &layers_;
    double tolerance_;
    std::vector<EdgeUse> edges_;
    double cell_;
    PlaceGrid grid_;
};

} // namespace

void MeshRepair::find_layers(double tolerance) {
    DisjointSets sets(mesh_.position.size());
    for (std::size_t f = 0; f < mesh_.face_count(); ++f)
        for (std::uint32_t c = mesh_.face_offset[f]; c < mesh_.face_offset[f + 1]; ++c)
            sets.unite(mesh_.corner_position[mesh_.face_offset[f]], mesh_.corner_position[c]);
    std::vector<std::uint32_t> part(mesh_.position.size());
    for (std::uint32_t v = 0; v < part.size(); ++v)
        part[v] = sets.find(v);
    const OpenEdges open(mesh_, open_edges(edges(), {}), tolerance, layers_);
    std::unordered_map<std::uint32_t, std::vector<RimEdge>> rims; // of the ends of open edges
    for (const EdgeUse &e : open.edges()) {
        rims[e.forward ? e.low : e.high].push_back(rim_edge(mesh_, e.face, e.corner, true));
        rims[e.forward ? e.high : e.low].push_back(rim_edge(mesh_, e.face, e.corner, false));
    }
    LayerVotes votes;
    std::size_t turn = 0;
    for (const std::uint32_t v : ends_of(open.edges())) {
        look_at_stop(progress_, turn++);
        open.vote(v, rims[v], part, votes);
    }
    const auto faces_of = [&](std::uint32_t wanted) {
        std::vector<std::uint32_t> faces;
        for (std::uint32_t f = 0; f < mesh_.face_count(); ++f)
            if (part[mesh_.corner_position[mesh_.face_offset[f]]] == wanted)
                faces.push_back(f);
        return faces;
    };
    std::set<std::pair<std::uint32_t, std::uint32_t>> layers;
    for (const auto &[one, other] : votes.candidates()) {
        look_at_stop(progress_);
        if (lie_on_each_other(mesh_, faces_of(one), faces_of(other), kLayerTolerances * tolerance))
            layers.insert({one, other});
    }
    layers_ = LayeredParts(std::move(part), std::move(layers));
    for (const std::uint32_t v : ends_of(open.edges()))
        if (layers_.has_any(v)) {
            ++report_.seams.layered;
            keep_place(report_.seams.first_place, "two_layers", mesh_.position[v]);
        }
}

std::size_t MeshRepair::count_open_vertices() { return ends_of(open_edges(edges(), {})).size(); }

std::vector<Insertion> MeshRepair::find_insertions(double tolerance, const VertexSet &allowed) {
    const OpenEdges open(mesh_, open_edges(edges(), allowed), tolerance, layers_);
    std::vector<Insertion> insertions;
    std::size_t turn = 0;
    for (const std::uint32_t v : ends_of(open.edges())) {
        look_at_stop(progress_, turn++);
        if (const auto insertion = open.nearest(v))
            insertions.push_back(*insertion);
    }
    std::sort(insertions.begin(), insertions.end(), [](const Insertion &a, const Insertion &b) {
        return std::tie(a.corner, a.t, a.vertex) < std::tie(b.corner, b.t, b.vertex);
    });
    // Two vertices at one place of an edge would make an edge of no length: the second waits.
    const auto last = std::unique(insertions.begin(), insertions.end(),
                                  [](const Insertion &a, const Insertion &b) {
                                      return a.corner == b.corner && b.t - a.t < kInnerShare;
                                  });
    insertions.erase(last, insertions.end());
    return insertions;
}

} // namespace tsuya::garment

#include "tsuya/garment/seams.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "edges.h"
#include "place_grid.h"
#include "split_triangle.h"
#include "topology.h"

namespace tsuya::garment {
namespace {

/// A vertex moves by less than this share of its shortest edge.
constexpr double kEdgeShare = 0.45;
/// A vertex is put into an edge only this far from its ends, as a share of the edge, and farther
/// than the tolerance: a vertex nearer to an end is that end's affair.
constexpr double kInnerShare = 0.02;
/// Rounds of T-junctions; each can uncover others on the edges that it made.
constexpr int kMaxRounds = 8;

struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::max()};
    glm::dvec3 upper{std::numeric_limits<double>::lowest()};
};

Box bounds(const PolygonMesh &mesh) {
    Box box;
    for (const glm::dvec3 &p : mesh.position) {
        box.lower = glm::min(box.lower, p);
        box.upper = glm::max(box.upper, p);
    }
    return box;
}

/// Sides of edges that only one face has.
std::vector<EdgeUse> open_edges(const PolygonMesh &mesh) {
    std::vector<EdgeUse> open;
    EdgeTable(mesh).for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() == 1)
            open.push_back(uses[0]);
    });
    return open;
}

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

/// Clusters of boundary vertices that become one vertex.
class VertexJoiner {
  public:
    VertexJoiner(const PolygonMesh &mesh, double tolerance)
        : mesh_(mesh), tolerance_(tolerance), parent_(mesh.position.size()),
          members_(mesh.position.size()), faces_(mesh.position.size()) {
        std::iota(parent_.begin(), parent_.end(), 0u);
        const HalfEdgeMesh half_edges = make_half_edges(mesh);
        for (const auto v : half_edges.vertices())
            if (half_edges.is_boundary(v) && !half_edges.is_isolated(v))
                add_boundary_vertex(half_edges, v);
    }

    void join(SeamReport &report) {
        report.boundary_before = boundary_.size();
        struct Pair {
            double distance;
            std::uint32_t a, b;
        };
        std::vector<Pair> pairs;
        PlaceGrid grid(bounds(mesh_).lower, std::max(2.0 * tolerance_, 1e-300));
        for (const std::uint32_t v : boundary_)
            grid.insert(v, mesh_.position[v] - tolerance_, mesh_.position[v] + tolerance_);
        for (const std::uint32_t a : boundary_)
            for (const std::uint32_t b : grid.at(mesh_.position[a])) {
                const double d = glm::distance(mesh_.position[a], mesh_.position[b]);
                if (a < b && d <= std::min(reach_[a], reach_[b]))
                    pairs.push_back({d, a, b});
            }
        std::sort(pairs.begin(), pairs.end(), [](const Pair &p, const Pair &q) {
            return std::tie(p.distance, p.a, p.b) < std::tie(q.distance, q.a, q.b);
        });
        pairs.erase(
            std::unique(pairs.begin(), pairs.end(),
                        [](const Pair &p, const Pair &q) { return p.a == q.a && p.b == q.b; }),
            pairs.end());
        for (const Pair &p : pairs)
            join_pair(p.a, p.b, report);
    }

    /// The mesh with every cluster at the mean of its members.
    PolygonMesh result() {
        PolygonMesh out = mesh_;
        for (const std::uint32_t v : boundary_) {
            if (find_set(parent_, v) != v)
                continue;
            glm::dvec3 sum(0.0);
            for (const std::uint32_t m : members_[v])
                sum += mesh_.position[m] - mesh_.position[v];
            out.position[v] += sum / static_cast<double>(members_[v].size());
        }
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
    }

    void join_pair(std::uint32_t a, std::uint32_t b, SeamReport &report) {
        a = find_set(parent_, a);
        b = find_set(parent_, b);
        if (a == b)
            return;
        double widest = 0.0;
        for (const std::uint32_t m : members_[a])
            for (const std::uint32_t n : members_[b])
                widest = std::max(widest, glm::distance(mesh_.position[m], mesh_.position[n]));
        for (const std::uint32_t f : faces_[a])
            if (std::find(faces_[b].begin(), faces_[b].end(), f) != faces_[b].end())
                return;
        if (widest > tolerance_)
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
    double tolerance_;
    std::vector<std::uint32_t> parent_;
    std::vector<std::vector<std::uint32_t>> members_, faces_;
    std::vector<std::uint32_t> boundary_;
    std::vector<double> reach_; ///< how far a vertex may be joined
};

/// A vertex to be put into an edge, at `t` from the start of the edge's side.
struct Insertion {
    std::uint32_t corner; ///< where the side of the edge starts
    double t;
    std::uint32_t vertex;
    double distance;
    std::uint32_t origin = 0; ///< see Sewn
};

/// A mesh while it is being sewn. `origin` tells, per corner, its vertex before anything was
/// joined, so that edges which were laid onto each other can be told apart. A new corner gets a new
/// number, the same on both sides of an edge inside a panel.
struct Sewn {
    PolygonMesh mesh;
    std::vector<std::uint32_t> origin;
    std::uint32_t next_origin = 0;
    bool triangles = false; ///< all faces are, and shall stay, triangles
};

/// Open edges by place.
class OpenEdges {
  public:
    OpenEdges(const PolygonMesh &mesh, double tolerance)
        : mesh_(mesh), tolerance_(tolerance), edges_(open_edges(mesh)),
          grid_(bounds(mesh).lower, cell_size()) {
        for (std::uint32_t i = 0; i < edges_.size(); ++i) {
            const glm::dvec3 a = mesh.position[edges_[i].low], b = mesh.position[edges_[i].high];
            grid_.insert(i, glm::min(a, b) - tolerance, glm::max(a, b) + tolerance);
        }
    }

    const std::vector<EdgeUse> &edges() const { return edges_; }

    /// The nearest open edge that `v` lies on but does not touch.
    std::optional<Insertion> nearest(std::uint32_t v) const {
        std::optional<Insertion> best;
        const glm::dvec3 p = mesh_.position[v];
        for (const std::uint32_t i : grid_.at(p)) {
            const EdgeUse &e = edges_[i];
            if (face_has(e.face, v))
                continue;
            const glm::dvec3 a = mesh_.position[mesh_.corner_position[e.corner]];
            const glm::dvec3 b =
                mesh_.position[mesh_.corner_position[mesh_.next(e.face, e.corner)]];
            const double length2 = glm::dot(b - a, b - a);
            const double t = length2 > 0.0 ? glm::dot(p - a, b - a) / length2 : 0.0;
            if (t < kInnerShare || t > 1.0 - kInnerShare ||
                std::min(glm::distance(p, a), glm::distance(p, b)) <= tolerance_)
                continue;
            const double distance = glm::distance(p, a + t * (b - a));
            const double reach = std::min(tolerance_, kEdgeShare * std::sqrt(length2));
            if (distance <= reach && (!best || distance < best->distance))
                best = Insertion{e.corner, t, v, distance};
        }
        return best;
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
    double tolerance_;
    std::vector<EdgeUse> edges_;
    PlaceGrid grid_;
};

/// A face with its new corners, and where they lie in the plane of a triangle.
struct GrownFace {
    std::vector<std::uint32_t> vertex;
    std::vector<std::int32_t> uv;
    std::vector<glm::dvec2> plane;
    std::vector<std::uint32_t> origin;
};

/// The corners of a triangle in its own plane.
std::array<glm::dvec2, 3> flatten(const PolygonMesh &mesh, std::size_t f) {
    const std::uint32_t *v = &mesh.corner_position[mesh.face_offset[f]];
    const glm::dvec3 ab = mesh.position[v[1]] - mesh.position[v[0]];
    const glm::dvec3 ac = mesh.position[v[2]] - mesh.position[v[0]];
    const double length = glm::length(ab);
    if (!(length > 0.0))
        return {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
    return {glm::dvec2(0, 0), glm::dvec2(length, 0),
            glm::dvec2(glm::dot(ac, ab) / length, glm::length(glm::cross(ab, ac)) / length)};
}

GrownFace grow_face(const Sewn &sewn, std::size_t f, std::span<const Insertion> insertions,
                    std::vector<glm::dvec2> &uvs) {
    const PolygonMesh &mesh = sewn.mesh;
    GrownFace grown;
    const std::uint32_t first = mesh.face_offset[f];
    const auto corners = mesh.face_size(f) == 3 ? flatten(mesh, f) : std::array<glm::dvec2, 3>{};
    for (std::uint32_t c = first; c < mesh.face_offset[f + 1]; ++c) {
        const std::uint32_t n = mesh.next(f, c);
        const glm::dvec2 a = corners[(c - first) % 3], b = corners[(n - first) % 3];
        grown.vertex.push_back(mesh.corner_position[c]);
        grown.uv.push_back(mesh.corner_uv[c]);
        grown.plane.push_back(a);
        grown.origin.push_back(sewn.origin[c]);
        for (const Insertion &i : insertions) {
            if (i.corner != c)
                continue;
            grown.origin.push_back(i.origin);
            grown.vertex.push_back(i.vertex);
            grown.plane.push_back(a + i.t * (b - a));
            if (mesh.corner_uv[c] < 0 || mesh.corner_uv[n] < 0) {
                grown.uv.push_back(-1);
                continue;
            }
            const glm::dvec2 s = uvs[static_cast<std::size_t>(mesh.corner_uv[c])];
            const glm::dvec2 e = uvs[static_cast<std::size_t>(mesh.corner_uv[n])];
            grown.uv.push_back(static_cast<std::int32_t>(uvs.size()));
            uvs.push_back((1.0 - i.t) * s + i.t * e);
        }
    }
    return grown;
}

/// Puts the vertices into their edges. `insertions` are sorted by corner, then t.
Sewn insert_vertices(const Sewn &sewn, const std::vector<Insertion> &insertions) {
    const PolygonMesh &mesh = sewn.mesh;
    Sewn out{
        .mesh = {}, .origin = {}, .next_origin = sewn.next_origin, .triangles = sewn.triangles};
    out.mesh.position = mesh.position;
    out.mesh.uv = mesh.uv;
    out.mesh.panel_name = mesh.panel_name;
    std::size_t next = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::size_t first = next;
        while (next < insertions.size() && insertions[next].corner < mesh.face_offset[f + 1])
            ++next;
        const GrownFace grown =
            grow_face(sewn, f, std::span(insertions).subspan(first, next - first), out.mesh.uv);
        if (next == first || !sewn.triangles) {
            out.mesh.add_face(grown.vertex, grown.uv, mesh.face_panel[f]);
            out.origin.insert(out.origin.end(), grown.origin.begin(), grown.origin.end());
            continue;
        }
        for (const auto &[a, b, c] : split_triangle(grown.plane)) {
            out.mesh.add_face({grown.vertex[a], grown.vertex[b], grown.vertex[c]},
                              {grown.uv[a], grown.uv[b], grown.uv[c]}, mesh.face_panel[f]);
            out.origin.insert(out.origin.end(),
                              {grown.origin[a], grown.origin[b], grown.origin[c]});
        }
    }
    return out;
}

/// Where a step laid an edge inside a panel onto another edge (a fold one edge deep), the edge gets
/// a vertex in its middle, so that the two stay different.
void halve_coincident_edges(Sewn &sewn) {
    const PolygonMesh &mesh = sewn.mesh;
    std::vector<glm::dvec3> middles;
    std::vector<Insertion> insertions;
    EdgeTable(mesh).for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() < 3)
            return;
        const auto origin = [&](const EdgeUse &use) {
            return std::pair(sewn.origin[corner_at(mesh, use, use.low)],
                             sewn.origin[corner_at(mesh, use, use.high)]);
        };
        for (std::size_t i = 0; i < uses.size(); ++i)
            for (std::size_t j = i + 1; j < uses.size(); ++j) {
                if (origin(uses[i]) != origin(uses[j]))
                    continue;
                const auto middle =
                    static_cast<std::uint32_t>(mesh.position.size() + middles.size());
                const glm::dvec3 low = mesh.position[uses[i].low];
                middles.push_back(low + 0.5 * (mesh.position[uses[i].high] - low));
                for (const EdgeUse &use : {uses[i], uses[j]})
                    insertions.push_back({use.corner, 0.5, middle, 0.0, sewn.next_origin});
                ++sewn.next_origin;
            }
    });
    if (insertions.empty())
        return;
    sewn.mesh.position.insert(sewn.mesh.position.end(), middles.begin(), middles.end());
    std::sort(insertions.begin(), insertions.end(),
              [](const Insertion &a, const Insertion &b) { return a.corner < b.corner; });
    sewn = insert_vertices(sewn, insertions);
    share_equal_uvs(sewn.mesh);
}

/// One round: every open vertex goes into the nearest open edge that it lies on.
std::vector<Insertion> find_insertions(const PolygonMesh &mesh, double tolerance) {
    const OpenEdges open(mesh, tolerance);
    std::vector<Insertion> insertions;
    for (const std::uint32_t v : ends_of(open.edges()))
        if (const auto insertion = open.nearest(v))
            insertions.push_back(*insertion);
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

} // namespace

PolygonMesh join_seams(const PolygonMesh &mesh, const SeamOptions &options, SeamReport &report) {
    report.tolerance = options.tolerance;
    if (options.tolerance < 0.0 || mesh.face_count() == 0) {
        report.boundary_before = report.boundary_after = ends_of(open_edges(mesh)).size();
        return mesh;
    }
    // Positions that are equal but for rounding count as equal even where the tolerance is 0.
    constexpr double kRounding = 1e-12;
    const Box box = bounds(mesh);
    const double tolerance =
        std::max(options.tolerance, kRounding * glm::distance(box.lower, box.upper));
    VertexJoiner joiner(mesh, tolerance);
    joiner.join(report);
    Sewn sewn{.mesh = joiner.result(),
              .origin = mesh.corner_position,
              .next_origin = static_cast<std::uint32_t>(mesh.position.size()),
              .triangles = true};
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        sewn.triangles &= mesh.face_size(f) == 3;
    halve_coincident_edges(sewn);
    for (int round = 0; round < kMaxRounds; ++round) {
        std::vector<Insertion> insertions = find_insertions(sewn.mesh, tolerance);
        if (insertions.empty())
            break;
        for (Insertion &i : insertions) {
            i.origin = sewn.next_origin++;
            report.largest_gap = std::max(report.largest_gap, i.distance);
        }
        report.splits += insertions.size();
        sewn = insert_vertices(sewn, insertions);
        halve_coincident_edges(sewn);
    }
    const std::vector<EdgeUse> open = open_edges(sewn.mesh);
    report.boundary_after = ends_of(open).size();
    report.unresolved = find_insertions(sewn.mesh, tolerance).size();
    return std::move(sewn.mesh);
}

} // namespace tsuya::garment

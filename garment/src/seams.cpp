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
/// A vertex is put into an edge only this far from its ends, as a share of the edge.
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
            if (t < kInnerShare || t > 1.0 - kInnerShare)
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

GrownFace grow_face(const PolygonMesh &mesh, std::size_t f, std::span<const Insertion> insertions,
                    std::vector<glm::dvec2> &uvs) {
    GrownFace grown;
    const std::uint32_t first = mesh.face_offset[f];
    const auto corners = mesh.face_size(f) == 3 ? flatten(mesh, f) : std::array<glm::dvec2, 3>{};
    for (std::uint32_t c = first; c < mesh.face_offset[f + 1]; ++c) {
        const std::uint32_t n = mesh.next(f, c);
        const glm::dvec2 a = corners[(c - first) % 3], b = corners[(n - first) % 3];
        grown.vertex.push_back(mesh.corner_position[c]);
        grown.uv.push_back(mesh.corner_uv[c]);
        grown.plane.push_back(a);
        for (const Insertion &i : insertions) {
            if (i.corner != c)
                continue;
            grown.vertex.push_back(i.vertex);
            grown.plane.push_back(a + i.t * (b - a));
            if (mesh.corner_uv[c] < 0 || mesh.corner_uv[n] < 0) {
                grown.uv.push_back(-1);
                continue;
            }
            const glm::dvec2 s = uvs[static_cast<std::size_t>(mesh.corner_uv[c])];
            const glm::dvec2 e = uvs[static_cast<std::size_t>(mesh.corner_uv[n])];
            grown.uv.push_back(static_cast<std::int32_t>(uvs.size()));
            uvs.push_back(s + i.t * (e - s));
        }
    }
    return grown;
}

/// Puts the vertices into their edges. `insertions` are sorted by corner, then t.
PolygonMesh insert_vertices(const PolygonMesh &mesh, const std::vector<Insertion> &insertions,
                            bool triangles) {
    PolygonMesh out;
    out.position = mesh.position;
    out.uv = mesh.uv;
    out.panel_name = mesh.panel_name;
    std::size_t next = 0;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        const std::size_t first = next;
        while (next < insertions.size() && insertions[next].corner < mesh.face_offset[f + 1])
            ++next;
        const GrownFace grown =
            grow_face(mesh, f, std::span(insertions).subspan(first, next - first), out.uv);
        if (next == first || !triangles) {
            out.add_face(grown.vertex, grown.uv, mesh.face_panel[f]);
            continue;
        }
        for (const auto &[a, b, c] : split_triangle(grown.plane))
            out.add_face({grown.vertex[a], grown.vertex[b], grown.vertex[c]},
                         {grown.uv[a], grown.uv[b], grown.uv[c]}, mesh.face_panel[f]);
    }
    return out;
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
    PolygonMesh joined = joiner.result();

    bool triangles = true;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        triangles &= mesh.face_size(f) == 3;
    for (int round = 0; round < kMaxRounds; ++round) {
        const std::vector<Insertion> insertions = find_insertions(joined, tolerance);
        if (insertions.empty())
            break;
        joined = insert_vertices(joined, insertions, triangles);
        report.splits += insertions.size();
        for (const Insertion &i : insertions)
            report.largest_gap = std::max(report.largest_gap, i.distance);
    }
    const std::vector<EdgeUse> open = open_edges(joined);
    report.boundary_after = ends_of(open).size();
    report.unresolved = find_insertions(joined, tolerance).size();
    return joined;
}

} // namespace tsuya::garment

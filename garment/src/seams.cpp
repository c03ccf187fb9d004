#include "tsuya/garment/seams.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "edges.h"
#include "fans.h"
#include "place_grid.h"
#include "sewing.h"
#include "topology.h"

namespace tsuya::garment {
namespace {

/// A vertex moves by less than this share of its shortest edge.
constexpr double kEdgeShare = 0.45;
/// A vertex is put into an edge only this far from its ends, as a share of the edge, and farther
/// than the tolerance or the second share: a vertex nearer to an end is that end's affair.
constexpr double kInnerShare = 0.02;
constexpr double kEndShare = 0.1;
/// Rounds of T-junctions; each can uncover others on the edges that it made.
constexpr int kMaxRounds = 8;
/// Passes over slits; closing one can leave a shorter one.
constexpr int kMaxSlitPasses = 3;

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

/// The vertices that may be joined: those of `member`, or all where it is empty.
struct VertexSet {
    std::vector<bool> member{};
    bool has(std::uint32_t v) const { return member.empty() || (v < member.size() && member[v]); }
};

/// Sides of edges that only one face has.
std::vector<EdgeUse> open_edges(const PolygonMesh &mesh, const VertexSet &allowed) {
    std::vector<EdgeUse> open;
    EdgeTable(mesh).for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() == 1 && allowed.has(uses[0].low) && allowed.has(uses[0].high))
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

/// Open edges by place.
class OpenEdges {
  public:
    OpenEdges(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed)
        : mesh_(mesh), tolerance_(tolerance), edges_(open_edges(mesh, allowed)),
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

/// One round: every open vertex goes into the nearest open edge that it lies on.
std::vector<Insertion> find_insertions(const PolygonMesh &mesh, double tolerance,
                                       const VertexSet &allowed) {
    const OpenEdges open(mesh, tolerance, allowed);
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

/// Joins what lies within the tolerance.
PolygonMesh sew(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                SeamReport &report) {
    VertexJoiner joiner(mesh, tolerance, allowed);
    joiner.join(report);
    Sewn sewn{.mesh = joiner.result(),
              .origin = mesh.corner_position,
              .next_origin = static_cast<std::uint32_t>(mesh.position.size()),
              .triangles = true};
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        sewn.triangles &= mesh.face_size(f) == 3;
    halve_coincident_edges(sewn);
    for (int round = 0; round < kMaxRounds; ++round) {
        std::vector<Insertion> insertions = find_insertions(sewn.mesh, tolerance, allowed);
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
    return std::move(sewn.mesh);
}

double distance_to_segment(const glm::dvec3 &p, const glm::dvec3 &a, const glm::dvec3 &b) {
    const double length2 = glm::dot(b - a, b - a);
    const double t = length2 > 0.0 ? glm::clamp(glm::dot(p - a, b - a) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(p, a + t * (b - a));
}

/// True for a loop as narrow as `width`: all of its vertices but the two tips lie that near to an
/// edge of the loop that they do not touch.
bool is_slit(const std::vector<glm::dvec3> &loop, double width) {
    constexpr std::size_t kTips = 2;
    const std::size_t n = loop.size();
    std::size_t wide = 0;
    for (std::size_t i = 0; i < n && wide <= kTips; ++i) {
        bool near = false;
        for (std::size_t k = 1; k + 1 < n && !near; ++k)
            near = distance_to_segment(loop[i], loop[(i + k) % n], loop[(i + k + 1) % n]) <= width;
        wide += !near;
    }
    return wide <= kTips && wide < n;
}

/// Vertices of the slits of a manifold mesh. Returns the number of slits.
std::size_t find_slits(const PolygonMesh &mesh, double width, VertexSet &slits) {
    std::size_t count = 0;
    const HalfEdgeMesh half_edges = make_half_edges(mesh);
    slits.member.assign(mesh.position.size(), false);
    for (const BoundaryRun &run : boundary_runs(half_edges)) {
        std::vector<glm::dvec3> loop;
        for (const auto h : run)
            loop.push_back(
                mesh.position[static_cast<std::size_t>(half_edges.from_vertex_handle(h).idx())]);
        if (!is_slit(loop, width))
            continue;
        ++count;
        for (const auto h : run)
            slits.member[static_cast<std::size_t>(half_edges.from_vertex_handle(h).idx())] = true;
    }
    return count;
}

} // namespace

PolygonMesh join_seams(const PolygonMesh &mesh, const SeamOptions &options, SeamReport &report,
                       ManifoldReport &manifold) {
    report.tolerance = options.tolerance;
    report.boundary_before = ends_of(open_edges(mesh, {})).size();
    PolygonMesh joined = mesh;
    if (options.tolerance >= 0.0 && mesh.face_count() > 0) {
        // Positions that are equal but for rounding are equal even where the tolerance is 0.
        constexpr double kRounding = 1e-12;
        const Box box = bounds(mesh);
        const double tolerance =
            std::max(options.tolerance, kRounding * glm::distance(box.lower, box.upper));
        joined = make_manifold(sew(mesh, tolerance, {}, report), manifold);
        std::size_t in_slits = 0;
        glm::dvec3 first_slit(0.0);
        for (int pass = 0; options.slit_width > tolerance; ++pass) {
            VertexSet slits;
            const std::size_t found = find_slits(joined, options.slit_width, slits);
            in_slits = found == 0 ? 0
                                  : static_cast<std::size_t>(
                                        std::count(slits.member.begin(), slits.member.end(), true));
            if (found > 0)
                first_slit = joined.position[static_cast<std::size_t>(
                    std::find(slits.member.begin(), slits.member.end(), true) -
                    slits.member.begin())];
            if (found == 0 || pass == kMaxSlitPasses)
                break;
            report.slits += found;
            joined = make_manifold(sew(joined, options.slit_width, slits, report), manifold);
        }
        report.unresolved = std::max(in_slits, find_insertions(joined, tolerance, {}).size());
    }
    report.boundary_after = ends_of(open_edges(joined, {})).size();
    return joined;
}

} // namespace tsuya::garment

#include "tsuya/garment/seams.h"

#include <algorithm>

#include "repair/open_edges.h"
#include "repair/sewing.h"
#include "repair/slits.h"
#include "repair/vertex_joiner.h"

namespace tsuya::garment {
namespace {

/// Rounds of T-junctions; each can uncover others on the edges that it made.
constexpr int kMaxRounds = 8;
/// Passes over slits; closing one can leave a shorter one.
constexpr int kMaxSlitPasses = 3;

/// Joins what lies within the tolerance.
PolygonMesh sew(const PolygonMesh &mesh, double tolerance, const VertexSet &allowed,
                PositionRecipe &recipe, SeamReport &report) {
    Sewn sewn{.mesh = join_vertices(mesh, tolerance, allowed, recipe, report),
              .origin = mesh.corner_position,
              .next_origin = static_cast<std::uint32_t>(mesh.position.size()),
              .triangles = true};
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        sewn.triangles &= mesh.face_size(f) == 3;
    halve_coincident_edges(sewn, recipe);
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
        halve_coincident_edges(sewn, recipe);
    }
    return std::move(sewn.mesh);
}

/// Closes slits; returns the number of vertices in those that remain.
std::size_t close_slits(PolygonMesh &joined, double tolerance, double width, PositionRecipe &recipe,
                        SeamReport &report, ManifoldReport &manifold) {
    for (int pass = 0;; ++pass) {
        VertexSet slits;
        const std::size_t found = find_slits(joined, width, slits);
        if (found == 0)
            return 0;
        if (pass == kMaxSlitPasses)
            return static_cast<std::size_t>(
                std::count(slits.member.begin(), slits.member.end(), true));
        report.slits += found;
        // Sides that a single short edge holds apart cannot be joined: it goes first.
        const std::size_t collapsed = collapse_short_edges(joined, tolerance, slits, recipe);
        report.collapsed_edges += collapsed;
        if (collapsed > 0) {
            joined = make_manifold(joined, manifold, recipe);
            find_slits(joined, width, slits);
        }
        joined = make_manifold(sew(joined, width, slits, recipe, report), manifold, recipe);
    }
}

} // namespace

PolygonMesh join_seams(const PolygonMesh &mesh, const SeamOptions &options, SeamReport &report,
                       ManifoldReport &manifold, PositionRecipe &recipe) {
    report.tolerance = options.tolerance;
    report.boundary_before = ends_of(open_edges(mesh, {})).size();
    PolygonMesh joined = mesh;
    if (options.tolerance >= 0.0 && mesh.face_count() > 0) {
        // Positions that are equal but for rounding are equal even where the tolerance is 0.
        constexpr double kRounding = 1e-12;
        const Box box = bounds(mesh);
        const double tolerance =
            std::max(options.tolerance, kRounding * glm::distance(box.lower, box.upper));
        joined = make_manifold(sew(mesh, tolerance, {}, recipe, report), manifold, recipe);
        std::size_t in_slits = 0;
        if (options.slit_width > tolerance)
            in_slits = close_slits(joined, tolerance, options.slit_width, recipe, report, manifold);
        report.unresolved = std::max(in_slits, find_insertions(joined, tolerance, {}).size());
    }
    report.boundary_after = ends_of(open_edges(joined, {})).size();
    return joined;
}

} // namespace tsuya::garment

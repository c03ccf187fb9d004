#include "limit/tessellation_rates.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "limit/face_departure.h"
#include "limit/limit_size.h"
#include "limit/view_tolerance.h"
#include "mesh/stop.h"

namespace tsuya::garment {
namespace {

/// Pieces of an edge, as level 8 has them.
constexpr int kMaxRate = 256;
/// Rounds of measuring and raising. Each at most doubles a rate, and few faces need a second.
constexpr int kMaxRounds = 12;

/// What the second derivatives of a face ask for, all along the normal and divided by 8: a chord of
/// length h departs by h^2 / 8 of the second derivative along it.
struct Bend {
    double a = 0, b = 0, c = 0; ///< largest |P_uu|, |P_uv|, |P_vv|
    double diagonal = 0;        ///< largest |P_uu - 2 P_uv + P_vv|
};

int pieces(double bend, double tolerance) {
    const double n = std::sqrt(bend / tolerance);
    return n < kMaxRate ? std::max(1, static_cast<int>(std::ceil(n))) : kMaxRate;
}

/// Fewest cells of a quad, nu x nv, whose halves depart by the tolerance at most:
/// a / nu^2 + 2 b / (nu nv) + c / nv^2 <= tolerance.
glm::ivec2 quad_pieces(const Bend &bend, double tolerance) {
    glm::ivec2 best(kMaxRate);
    const int lowest_v = pieces(bend.c, tolerance);
    for (int v = lowest_v; v <= std::min(kMaxRate, 4 * lowest_v + 4); ++v) {
        const double left = tolerance - bend.c / v / v;
        int u = 1;
        if (left <= 0.0)
            continue;
        // left u^2 - (2 b / v) u - a >= 0
        const double half = bend.b / v;
        const double root = (half + std::sqrt(half * half + left * bend.a)) / left;
        if (!(root < kMaxRate))
            continue;
        u = std::max(1, static_cast<int>(std::ceil(root)));
        if (u * v < best.x * best.y)
            best = {u, v};
    }
    return best;
}

/// Points of a face where it is measured: of a triangle or quad, or of the sub-faces of others.
std::vector<glm::dvec2> measuring_points(const OpenSubdiv::Bfr::Parameterization &p, int corners) {
    std::vector<glm::dvec2> points;
    if (p.HasSubFaces()) {
        for (int sub = 0; sub < corners; ++sub)
            for (const glm::dvec2 local :
                 {glm::dvec2(0.1, 0.1), {0.9, 0.1}, {0.1, 0.9}, {0.5, 0.5}, {0.9, 0.9}}) {
                glm::dvec2 at;
                p.ConvertNormalizedSubFaceToCoord(sub, &local.x, &at.x);
                points.push_back(at);
            }
        return points;
    }
    if (corners == 3)
        return {{0.02, 0.02}, {0.96, 0.02}, {0.02, 0.96}, {0.5, 0.02},
                {0.02, 0.5},  {0.49, 0.49}, {0.33, 0.33}};
    for (const double v :
         {0.02, 0.5, 0.98}) // second derivatives of a cubic are largest at its ends
        for (const double u : {0.02, 0.5, 0.98})
            points.emplace_back(u, v);
    return points;
}

/// The numbers of one face: along each edge, and inside.
struct FaceNeed {
    std::vector<int> edge{};
    glm::ivec2 inner{1};
    double tolerance = 0.0; ///< metres

    /// Raises a number by what a departure asks for; false where nothing is to be done or it is
    /// as large as can be.
    bool raise(int &rate, double departure) const {
        if (!(departure > tolerance) || rate >= kMaxRate)
            return false;
        const double growth = std::min(2.0, 1.05 * std::sqrt(departure / tolerance));
        rate = std::min(kMaxRate, std::max(rate + 1, static_cast<int>(std::ceil(growth * rate))));
        return true;
    }
};

class RateChooser {
  public:
    RateChooser(const LimitSurface &surface, const SubdivideOptions &options)
        : surface_(surface), options_(options) {
        if (options.view)
            view_.emplace(*options.view);
    }

    FaceNeed need(std::size_t face, LimitSurface::Scratch &scratch) const {
        const PolygonMesh &mesh = surface_.mesh();
        const auto corners = static_cast<int>(mesh.face_size(face));
        const double tolerance = tolerance_of(face);
        FaceNeed need{.edge = std::vector<int>(static_cast<std::size_t>(corners), 1),
                      .tolerance = tolerance};
        if (!std::isfinite(tolerance))
            return need;
        surface_.prepare_positions(face, scratch);
        const Bend bend = measure(corners, scratch);
        if (corners == 4) {
            need.inner = quad_pieces(bend, tolerance);
            need.edge = {need.inner.x, need.inner.y, need.inner.x, need.inner.y};
        } else if (corners == 3) {
            // The middle of an even triangle departs by 4/3 of what its edges do.
            const double worst = 4.0 / 3.0 * std::max({bend.a, bend.c, bend.diagonal});
            need.inner = glm::ivec2(pieces(worst, tolerance));
            std::fill(need.edge.begin(), need.edge.end(), need.inner.x);
        } else {
            // A sub-face has half of the face's pieces, and coordinates of its own.
            const double worst = bend.a + 2.0 * bend.b + bend.c;
            need.inner = glm::ivec2(pieces(worst, tolerance));
            std::fill(need.edge.begin(), need.edge.end(), need.inner.x);
        }
        add_hems(face, tolerance, scratch, need);
        return need;
    }

  private:
    double tolerance_of(std::size_t face) const {
        double tolerance = options_.tolerance.value_or(std::numeric_limits<double>::infinity());
        if (!view_)
            return tolerance;
        const PolygonMesh &mesh = surface_.mesh();
        glm::dvec3 centre(0.0);
        const std::uint32_t first = mesh.face_offset[face], last = mesh.face_offset[face + 1];
        for (std::uint32_t c = first; c < last; ++c)
            centre += mesh.position[mesh.corner_position[c]] / static_cast<double>(last - first);
        double radius = 0.0;
        for (std::uint32_t c = first; c < last; ++c)
            radius =
                std::max(radius, glm::distance(centre, mesh.position[mesh.corner_position[c]]));
        // The limit surface stays about as near to its face as the face is large.
        return std::min(tolerance, view_->tolerance(centre, 1.5 * radius));
    }

    Bend measure(int corners, const LimitSurface::Scratch &scratch) const {
        Bend bend;
        for (const glm::dvec2 &at :
             measuring_points(scratch.surface.GetParameterization(), corners)) {
            const LimitCurvature c = surface_.curvature(at, scratch);
            const double a = glm::dot(c.normal, c.p_uu) / 8.0, b = glm::dot(c.normal, c.p_uv) / 8.0,
                         d = glm::dot(c.normal, c.p_vv) / 8.0;
            bend.a = std::max(bend.a, std::abs(a));
            bend.b = std::max(bend.b, std::abs(b));
            bend.c = std::max(bend.c, std::abs(d));
            bend.diagonal = std::max(bend.diagonal, std::abs(a - 2.0 * b + d));
        }
        return bend;
    }

    /// Along a hem the curve counts, also within the surface.
    void add_hems(std::size_t face, double tolerance, const LimitSurface::Scratch &scratch,
                  FaceNeed &need) const {
        const auto edges = surface_.topology().GetFaceEdges(static_cast<int>(face));
        const auto parameterization = scratch.surface.GetParameterization();
        for (int e = 0; e < edges.size(); ++e) {
            if (surface_.topology().GetEdgeFaces(edges[e]).size() != 1)
                continue;
            double bend = 0.0;
            for (const double t : {0.1, 0.5, 0.9}) {
                glm::dvec2 at;
                parameterization.GetEdgeCoord(e, t, &at.x);
                glm::dvec2 before, after;
                parameterization.GetEdgeCoord(e, t - 0.1, &before.x);
                parameterization.GetEdgeCoord(e, t + 0.1, &after.x);
                const glm::dvec3 p = surface_.sample(at, scratch).p;
                const glm::dvec3 a = surface_.sample(before, scratch).p - p;
                const glm::dvec3 b = surface_.sample(after, scratch).p - p;
                const glm::dvec3 chord = b - a;
                const double length2 = glm::dot(chord, chord);
                const glm::dvec3 second = (a + b) / 0.01;
                const glm::dvec3 across =
                    length2 > 0.0 ? second - glm::dot(second, chord) / length2 * chord : second;
                bend = std::max(bend, glm::length(across) / 8.0);
            }
            auto &rate = need.edge[static_cast<std::size_t>(e)];
            rate = std::max(rate, pieces(bend, tolerance));
        }
    }

    const LimitSurface &surface_;
    const SubdivideOptions &options_;
    std::optional<ViewNeed> view_;
};

/// Measures the triangles of a face; true where a number had to be raised.
bool measure_and_raise(const LimitSurface &surface, std::size_t f, const FacePattern &pattern,
                       const TessellationRates &rates, const LimitSurface::Scratch &scratch,
                       FaceNeed &need) {
    const double departure = face_departure(surface, pattern, scratch);
    if (!(departure > need.tolerance))
        return false;
    // Edges only where they are to blame, since they concern the neighbours as well.
    const auto edges = surface.topology().GetFaceEdges(static_cast<int>(f));
    bool raised = false;
    for (int e = 0; e < edges.size(); ++e) {
        int &rate = need.edge[static_cast<std::size_t>(e)];
        rate = rates.edge[static_cast<std::size_t>(edges[e])];
        raised |= need.raise(rate, edge_departure(surface, e, rate, scratch));
    }
    if (raised)
        return true;
    need.inner = rates.inner[f];
    raised |= need.raise(need.inner.x, departure);
    raised |= need.raise(need.inner.y, departure);
    return raised;
}

bool cut_alike(const LimitSurface &surface, std::size_t f, const TessellationRates &a,
               const TessellationRates &b) {
    const auto edges = surface.topology().GetFaceEdges(static_cast<int>(f));
    return a.inner[f] == b.inner[f] && std::all_of(edges.begin(), edges.end(), [&](int edge) {
               const auto e = static_cast<std::size_t>(edge);
               return a.edge[e] == b.edge[e];
           });
}

/// The numbers of all faces: an edge gets the larger of its two faces.
TessellationRates join_needs(const LimitSurface &surface, const std::vector<FaceNeed> &need) {
    TessellationRates rates = uniform_rates(surface, 1);
    for (std::size_t f = 0; f < need.size(); ++f) {
        const auto edges = surface.topology().GetFaceEdges(static_cast<int>(f));
        for (int e = 0; e < edges.size(); ++e) {
            int &rate = rates.edge[static_cast<std::size_t>(edges[e])];
            rate = std::max(rate, need[f].edge[static_cast<std::size_t>(e)]);
        }
        rates.inner[f] = need[f].inner;
    }
    // A quad of one row whose edges differ would become a fan about its centre, as long as the row.
    for (std::size_t f = 0; f < need.size(); ++f) {
        const auto edges = surface.topology().GetFaceEdges(static_cast<int>(f));
        glm::ivec2 &inner = rates.inner[f];
        bool regular = true;
        for (int e = 0; e < edges.size(); ++e)
            regular &= rates.edge[static_cast<std::size_t>(edges[e])] == inner[e % 2];
        if (edges.size() == 4 && !regular && std::max(inner.x, inner.y) > 1)
            inner = glm::max(inner, glm::ivec2(2));
    }
    return rates;
}

} // namespace

TessellationRates uniform_rates(const LimitSurface &surface, int rate) {
    return {std::vector<int>(static_cast<std::size_t>(surface.topology().GetNumEdges()), rate),
            std::vector<glm::ivec2>(surface.mesh().face_count(), glm::ivec2(rate))};
}

TessellationRates adaptive_rates(const LimitSurface &surface, const SubdivideOptions &options,
                                 const Progress &progress) {
    const RateChooser chooser(surface, options);
    const std::size_t faces = surface.mesh().face_count();
    std::vector<FaceNeed> need(faces);
    tbb::enumerable_thread_specific<LimitSurface::Scratch> scratches;
    const auto for_each_face = [&](auto &&work) {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, faces, 64), [&](auto range) {
            for (std::size_t f = range.begin(); f != range.end() && !progress.stopped(); ++f)
                work(f, scratches.local());
        });
        look_at_stop(progress);
    };
    for_each_face(
        [&](std::size_t f, LimitSurface::Scratch &scratch) { need[f] = chooser.need(f, scratch); });
    // The estimate is too low about extraordinary vertices and where rates differ along a face.
    TessellationRates rates = join_needs(surface, need), before;
    for (int round = 0; round < kMaxRounds; ++round) {
        need_room(surface, rates, options);
        const FacePatterns patterns(surface, rates, progress);
        std::atomic<bool> raised = false;
        for_each_face([&](std::size_t f, LimitSurface::Scratch &scratch) {
            if (!std::isfinite(need[f].tolerance) ||
                (round > 0 && cut_alike(surface, f, before, rates)))
                return;
            surface.prepare_positions(f, scratch);
            if (measure_and_raise(surface, f, patterns.of(f), rates, scratch, need[f]))
                raised = true;
        });
        if (!raised)
            break;
        before = std::exchange(rates, join_needs(surface, need));
    }
    return rates;
}

TessellationRates choose_rates(const LimitSurface &surface, const SubdivideOptions &options,
                               const Progress &progress) {
    begin_stage(progress, "subdivide: rates");
    TessellationRates rates = options.tolerance || options.view
                                  ? adaptive_rates(surface, options, progress)
                                  : uniform_rates(surface, 1 << options.level);
    need_room(surface, rates, options);
    return rates;
}

} // namespace tsuya::garment

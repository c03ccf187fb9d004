#include <algorithm>
#include <cmath>
#include <utility>

#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

/// Rounds of T-junctions; each can uncover others on the edges that it made.
constexpr int kMaxRounds = 8;
/// Passes over slits; closing one can leave a shorter one.
constexpr int kMaxSlitPasses = 3;

constexpr double kTolerance = 0.5e-3; // metres
constexpr double kLeastSize = 0.03, kLargestSize = 30.0;

/// By what lengths on a garment of this size are larger than on one that people wear: a power of
/// ten, 1 for what may be worn.
double scale_of(double size) {
    if (!(size > 0.0) || (size >= kLeastSize && size <= kLargestSize))
        return 1.0;
    return std::pow(10.0, std::round(std::log10(size)));
}

} // namespace

void MeshRepair::join_seams() {
    SeamReport &report = report_.seams;
    const glm::dvec3 size = report_.upper - report_.lower;
    const double scale = options_.tolerance ? 1.0 : scale_of(std::max({size.x, size.y, size.z}));
    options_.slit_width *= scale;
    report.tolerance = options_.tolerance.value_or(scale * kTolerance);
    // Positions that are equal but for rounding are equal even where the tolerance is 0.
    constexpr double kRounding = 1e-12;
    const Box box = bounds(mesh_);
    const double tolerance =
        std::max(report.tolerance, kRounding * glm::distance(box.lower, box.upper));
    reach_ = std::max(tolerance, options_.slit_width);
    report.boundary_before = open_sides().vertices().size();
    if (report.tolerance >= 0.0) {
        find_layers(tolerance);
        sew(tolerance, {});
        make_manifold();
        const std::size_t in_slits =
            options_.slit_width > tolerance ? close_slits(tolerance) : std::size_t{0};
        const Pairing left =
            pair_sides(mesh_, open_sides(), {tolerance, {}, layers_, false}, progress_);
        report.unresolved = std::max(in_slits, left.insertions.size());
        for (const Insertion &insertion : left.insertions)
            keep_place(report.first_place, "unresolved_seams", mesh_.position[insertion.vertex]);
    }
    report.boundary_after = open_sides().vertices().size();
}

void MeshRepair::sew(double tolerance, const VertexSet &allowed) {
    sewing_ = {.origin = mesh_.corner_position,
               .next_origin = static_cast<std::uint32_t>(mesh_.position.size()),
               .triangles = true};
    for (std::size_t f = 0; f < mesh_.face_count(); ++f)
        sewing_.triangles &= mesh_.face_size(f) == 3;
    // Vertices are joined once: what was moved to a mean is not moved on.
    for (int round = 0; round <= kMaxRounds; ++round) {
        Pairing pairing =
            pair_sides(mesh_, open_sides(), {tolerance, allowed, layers_, round == 0}, progress_);
        if (pairing.empty())
            break;
        apply(std::move(pairing));
        halve_coincident_edges();
    }
}

std::size_t MeshRepair::close_slits(double tolerance) {
    SeamReport &report = report_.seams;
    for (int pass = 0;; ++pass) {
        Slits slits = find_slits();
        if (slits.count == 0)
            return 0;
        const std::vector<bool> &member = slits.vertices.member;
        if (pass == kMaxSlitPasses)
            return static_cast<std::size_t>(std::count(member.begin(), member.end(), true));
        report.slits += slits.count;
        // Sides that a single short edge holds apart cannot be joined: it goes first.
        const std::size_t collapsed = collapse_short_edges(tolerance, slits.vertices);
        report.collapsed_edges += collapsed;
        if (collapsed > 0) {
            make_manifold();
            slits = find_slits();
        }
        sew(options_.slit_width, slits.vertices);
        make_manifold();
    }
}

} // namespace tsuya::garment

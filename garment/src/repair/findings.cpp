#include <algorithm>
#include <cmath>
#include <sstream>

#include "repair/mesh_repair.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::garment {
namespace {

/// Heights of a garment in metres that need no remark.
constexpr double kLowest = 0.15, kHighest = 2.5;

std::string number(double value) {
    std::ostringstream text;
    text.precision(4);
    text << value;
    return text.str();
}

std::string degrees(double radians) { return number(radians / kDegree); }

class Findings {
  public:
    explicit Findings(Report &report) : report_(report) {}
    /// The first place of a key, the file before the joined mesh.
    std::string place(const std::string &key) const {
        for (const FirstPlaces *places : {&report_.file.first_place, &report_.joined.first_place,
                                          &report_.seams.first_place, &report_.first_place})
            if (const auto it = places->find(key); it != places->end())
                return it->second;
        return "";
    }

    void add(Severity severity, std::string key, std::string what, std::string action,
             std::string where = "") {
        report_.findings.push_back(
            {severity, std::move(key), std::move(what), std::move(where), std::move(action)});
    }
    /// Only where something was counted. \param one, many how `what` begins, of one and of several
    void count(std::size_t n, Severity severity, const std::string &key, const std::string &one,
               const std::string &many, const std::string &what, std::string action) {
        if (n > 0)
            add(severity, key, detail::counted(n, one, many) + " " + what, std::move(action),
                place(key));
    }

  private:
    Report &report_;
};

/// The unit that would make a garment of this height, or an empty string.
std::string likely_unit(double height) {
    const std::pair<const char *, double> units[] = {
        {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}};
    for (const auto &[name, metres] : units)
        if (height * metres >= 0.3 && height * metres <= 2.0)
            return name;
    return "";
}

void find_units(const Report &report, Findings &findings) {
    const glm::dvec3 size = report.upper - report.lower;
    const double height = std::max({size.x, size.y, size.z});
    if (height >= kLowest && height <= kHighest)
        return;
    const std::string unit = likely_unit(height);
    findings.add(
        Severity::warning, "unusual_size", "the mesh measures " + number(height) + " m at most",
        unit.empty() ? "kept; state the unit of the file if it is another (--unit)"
                     : "kept; if it was read in metres, the file is probably in " + unit +
                           ": state --unit " + unit + ", in a scene unit = \"" + unit + "\"");
}

void find_topology(const Report &r, Findings &f) {
    const auto note = Severity::note, warning = Severity::warning;
    f.count(r.file.degenerate_faces, note, "degenerate_faces",
            "face has fewer than 3 different vertices or names",
            "faces have fewer than 3 different vertices or name", "one twice", "dropped");
    f.count(r.file.duplicate_faces, warning, "duplicate_faces", "face has", "faces have",
            "the same vertices as another", "dropped");
    f.count(r.file.isolated_vertices, note, "isolated_vertices", "vertex belongs",
            "vertices belong", "to no face", "dropped");
    f.count(r.file.non_manifold_edges, warning, "non_manifold_edges", "edge borders",
            "edges border", "more than two faces", "taken apart in pairs");
    f.count(r.file.non_manifold_vertices, warning, "non_manifold_vertices", "fan of faces meets",
            "fans of faces meet", "others in a vertex alone", "given a vertex of their own");
    f.count(r.file.flipped_faces + r.joined.flipped_faces, warning, "flipped_faces",
            "face is turned against its", "faces are turned against their", "neighbours",
            "turned over");
    f.count(r.concave_faces, note, "concave_faces", "face is", "faces are",
            "concave, and subdivision would fold them", "cut into triangles");
    f.count(r.crossed_faces, warning, "crossed_faces", "concave face crosses",
            "concave faces cross", "other edges of the mesh or of their own",
            "kept, and folded by subdivision; cut them in the program that made them");
    f.count(r.file.unorientable_edges + r.joined.unorientable_edges, warning, "unorientable_edges",
            "edge lies", "edges lie", "on a surface that has one side only", "cut open");
    f.count(r.joined.non_manifold_edges, note, "layered_seams", "edge joins", "edges join",
            "more than two layers of cloth", "layers joined in pairs");
    f.count(r.file.detached_faces + r.joined.detached_faces, warning, "detached_faces",
            "face could not be kept with its", "faces could not be kept with their", "neighbours",
            "cut off");
    f.count(r.joined.duplicate_faces + r.joined.degenerate_faces, note, "collapsed_faces",
            "face lost its", "faces lost their", "area when seams were joined", "dropped");
}

void find_seams(const Report &r, Findings &f) {
    f.count(r.seams.joined, Severity::note, "joined_vertices", "boundary vertex lies",
            "boundary vertices lie",
            "at another panel's (largest gap " + number(1e3 * r.seams.largest_gap) + " mm)",
            "joined");
    f.count(r.seams.layered, Severity::note, "two_layers", "boundary vertex lies",
            "boundary vertices lie", "on another layer of cloth", "layers not sewn together");
    f.count(r.seams.splits, Severity::note, "t_junctions", "boundary vertex lies",
            "boundary vertices lie", "on another panel's edge", "put into that edge");
    f.count(r.seams.slits, Severity::note, "slits", "gap along a seam is", "gaps along seams are",
            "wider than the tolerance but narrow", "closed");
    f.count(r.seams.collapsed_edges, Severity::note, "collapsed_edges",
            "edge shorter than the tolerance holds", "edges shorter than the tolerance hold",
            "a gap open", "their ends made one vertex");
    f.count(r.seams.unresolved, Severity::warning, "unresolved_seams", "boundary vertex lies",
            "boundary vertices lie", "near another boundary and could not be joined",
            "look at the seam, or state another tolerance of sewing");
    double length = 0.0;
    for (const BoundaryLoop &loop : r.openings)
        length += loop.length;
    f.count(r.openings.size(), Severity::note, "openings", "opening with", "openings with",
            number(length) + " m of edge", "left open; the edge becomes a smooth curve");
}

/// Cloth shears a lot before it buckles, but hardly beyond this.
constexpr double kUsualShear = 35.0 * kDegree;
/// Share of stretch between the 5th and 95th percentile that draped cloth hardly has.
constexpr double kUsualStretch = 1.3;

void find_shear(const Report &r, Findings &f) {
    constexpr double kRight = 0.5 * kPi;
    const double shear = std::max(kRight - r.warp_weft_angle.p5, r.warp_weft_angle.p95 - kRight);
    if (r.warp_weft_angle.p50 > 0.0 && shear > kUsualShear)
        f.add(Severity::note, "strong_shear",
              "warp and weft enclose " + degrees(r.warp_weft_angle.p5) + " to " +
                  degrees(r.warp_weft_angle.p95) + " degrees (5th and 95th percentile)",
              "both directions kept; the warp leads");
    for (const auto &[name, p] :
         {std::pair("u", r.metres_per_uv_weft), std::pair("v", r.metres_per_uv_warp)})
        if (p.p5 > 0.0 && p.p95 / p.p5 > kUsualStretch)
            f.add(Severity::note, "uneven_stretch",
                  std::string(name) + " measures " + number(p.p5) + " to " + number(p.p95) +
                      " m a unit (5th and 95th percentile)",
                  "kept; the pattern stretches with the cloth");
}

void find_uv(const Report &r, Findings &f) {
    if (r.faces_without_uv == r.faces || r.uvs == 0) {
        f.add(Severity::note, "no_uv", "no face has UVs",
              "no yarn directions unless the warp is stated: --grain vertical, in a scene "
              "invented_grain_deg = 0");
        return;
    }
    f.count(r.faces_without_uv, Severity::warning, "faces_without_uv", "face has", "faces have",
            "no UV", "directions spread from their neighbours");
    f.count(r.faces_without_uv_area, Severity::warning, "faces_without_uv_area", "face has",
            "faces have", "UVs without area", "directions spread from their neighbours");
    constexpr double kMostBad = 0.05; // FrameOptions::max_degenerate_area
    if (r.area > 0.0 && r.area_without_uv > kMostBad * r.area)
        f.add(
            Severity::warning, "much_without_uv",
            number(100.0 * r.area_without_uv / r.area) + " % of the area has no usable UV",
            "cloth with more than 5 % is refused: state the direction of the warp there (--grain, "
            "invented_grain_deg), or allow more (--max-degenerate-area, max_degenerate_area)");
    // Pattern pieces are tens of faces and more; a file has a few dozen of them.
    constexpr std::size_t kManyIslands = 256, kFewFaces = 16;
    if (r.uv_islands > kManyIslands && r.uv_islands * kFewFaces > r.faces)
        f.add(Severity::warning, "shattered_uv",
              std::to_string(r.uv_islands) + " UV islands for " + std::to_string(r.faces) +
                  " faces",
              "kept; each has a grain of its own, so highlights break up at its edges: export the "
              "UVs "
              "of the pattern pieces");
    f.count(r.mirrored_islands, Severity::note, "mirrored_islands", "UV island is",
            "UV islands are", "mirrored", "warp kept, weft turned round");
    if (r.mirrored_islands == 0)
        f.count(r.mirrored_faces, Severity::warning, "mirrored_faces",
                "face is mirrored inside its", "faces are mirrored inside their", "UV island",
                "warp kept, weft turned round");
    const double shear = r.metres_per_uv_weft.p50 / r.metres_per_uv_warp.p50;
    if (std::isfinite(shear) && (shear > 1.25 || shear < 0.8))
        f.add(Severity::warning, "uneven_uv_scale",
              "u measures " + number(r.metres_per_uv_weft.p50) + " m and v " +
                  number(r.metres_per_uv_warp.p50) + " m a unit",
              "kept; the pattern will look stretched");
    find_shear(r, f);
}

} // namespace

double choose_uv_scale(const std::optional<double> &stated, Report &report) {
    if (stated)
        return *stated;
    const double measured =
        std::sqrt(report.metres_per_uv_weft.p50 * report.metres_per_uv_warp.p50);
    if (!(measured > 0.0) || !std::isfinite(measured) || (measured >= 0.5 && measured <= 2.0))
        return 1.0;
    Findings(report).add(Severity::warning, "uv_scale_measured",
                         "a unit of UV measures " + number(measured) +
                             " m of cloth, so UVs are not in metres",
                         "scaled to metres by this number; state the scale to be sure "
                         "(--metres-per-uv, metres_per_uv)");
    return measured;
}

void MeshRepair::list_findings() {
    Findings findings(report_);
    if (!unit_stated_)
        find_units(report_, findings);
    find_topology(report_, findings);
    find_seams(report_, findings);
    if (!cloth_)
        return;
    find_uv(report_, findings);
    if (report_.panels == 0)
        findings.add(Severity::note, "no_panels", "the file names no group, object or material",
                     "UV islands stand for panels");
}

std::optional<Finding> find_up_axis(const Report &report) {
    constexpr double kLeastApart = 0.5, kMostAside = 0.2;
    const glm::dvec3 size = report.upper - report.lower;
    if (report.openings.size() < 2 || !(size.z > size.y))
        return std::nullopt;
    const glm::dvec3 between = report.openings[1].centre - report.openings[0].centre;
    const double apart = std::abs(between.z), aside = std::hypot(between.x, between.y);
    if (apart < kLeastApart * size.z || aside > kMostAside * apart)
        return std::nullopt;
    return Finding{.severity = Severity::warning,
                   .key = "probably_z_up",
                   .what = "the two longest openings lie above each other along z, as hem and neck "
                           "do where z is up",
                   .action = "read with y up; state --up z or --up y, in a scene up = \"z\""};
}

} // namespace tsuya::garment

#include "tsuya/garment/garment.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "tsuya/garment/check.h"
#include "tsuya/garment/obj.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Above this number of UV islands they do not stand for panels (a file with one UV a corner).
constexpr std::uint32_t kMaxIslandPanels = 256;

void stop_here(const Progress &progress) {
    if (progress.stopped())
        throw Interrupted("stopped while reading a garment");
}

void check_options(const Options &options, const std::string &where) {
    if (!(options.metres_per_unit > 0.0) || !std::isfinite(options.metres_per_unit))
        throw Error({"the unit of length is " + std::to_string(options.metres_per_unit) + " m",
                     where + ": metres_per_unit", "expected a positive number"});
    if (options.metres_per_uv &&
        (!(*options.metres_per_uv > 0.0) || !std::isfinite(*options.metres_per_uv)))
        throw Error({"the UV scale is " + std::to_string(*options.metres_per_uv) + " m",
                     where + ": metres_per_uv", "expected a positive number"});
}

/// The scale of UVs that applies, with a finding where it had to be measured.
double choose_uv_scale(const Options &options, Report &report) {
    const double weft = report.metres_per_uv_weft.p50, warp = report.metres_per_uv_warp.p50;
    if (options.metres_per_uv)
        return *options.metres_per_uv;
    const double measured = std::sqrt(weft * warp);
    if (!(measured > 0.0) || !std::isfinite(measured) || (measured >= 0.5 && measured <= 2.0))
        return 1.0;
    report.findings.push_back({Severity::warning, "uv_scale_measured",
                               "a unit of UV measures " + std::to_string(measured) +
                                   " m of cloth, so UVs are not in metres",
                               "", "scaled to metres by this number; state the scale to be sure"});
    return measured;
}

void find_repairs(Report &report) {
    const auto add = [&](std::size_t count, const char *key, const char *what, const char *action) {
        if (count > 0)
            report.findings.push_back(
                {Severity::note, key, std::to_string(count) + " " + what, "", action});
    };
    add(report.repaired_normals, "repaired_normals", "points of the surface have no tangent plane",
        "normal taken from beside them");
    add(report.repaired_frames, "repaired_frames", "points of the surface have a degenerate UV",
        "directions spread from the nearest of the same panel");
}

void refuse_warnings(const Report &report, const std::string &where) {
    std::vector<Problem> problems;
    for (const Finding &f : report.findings)
        if (f.severity == Severity::warning && problems.size() < kMaxProblems)
            problems.push_back({f.what, where, "strict: " + f.key});
    if (!problems.empty())
        throw Error(std::move(problems));
}

/// Runs `work`; errors that name the mesh alone get the name of the file in front.
template <typename Work> auto naming(const std::string &where, Work &&work) {
    try {
        return work();
    } catch (const Error &error) {
        std::vector<Problem> problems = error.problems();
        for (Problem &p : problems)
            if (!p.where.starts_with(where))
                p.where = p.where.empty() || p.where == "mesh" ? where : where + ": " + p.where;
        throw Error(std::move(problems));
    }
}

void name_panels(PolygonMesh &mesh) {
    std::uint32_t islands = 0;
    if (!mesh.panel_name.empty() || mesh.uv.empty())
        return;
    uv_islands(mesh, islands);
    if (islands <= kMaxIslandPanels)
        panels_from_uv_islands(mesh);
}

} // namespace

double metres_per(std::string_view unit) {
    constexpr std::array<std::pair<const char *, double>, 5> kUnits{
        {{"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}}};
    std::vector<std::string> names;
    for (const auto &[name, metres] : kUnits) {
        if (unit == name)
            return metres;
        names.emplace_back(name);
    }
    throw Error({"'" + std::string(unit) + "' is not a unit of length", "unit",
                 accepted_names(unit, names)});
}

LoadedGarment load(const PolygonMesh &mesh, const Options &options, const std::string &where,
                   const Progress &progress) {
    check_options(options, where);
    return naming(where, [&] {
        check_indices(mesh, where);
        PolygonMesh metres = mesh;
        for (glm::dvec3 &p : metres.position)
            p *= options.metres_per_unit;
        name_panels(metres);
        stop_here(progress);
        progress("garment: join seams", 0.0);
        Prepared prepared = prepare(metres, options.seams);
        stop_here(progress);
        LoadedGarment out;
        out.report = std::move(prepared.report);
        out.report.metres_per_uv = choose_uv_scale(options, out.report);
        if (!options.want_frames) {
            prepared.mesh.uv.clear();
            std::fill(prepared.mesh.corner_uv.begin(), prepared.mesh.corner_uv.end(), -1);
        }
        const LimitMesh limit = subdivide(prepared.mesh, options.subdivide, progress);
        FrameOptions frames = options.frames;
        frames.metres_per_uv = out.report.metres_per_uv;
        if (!options.want_frames)
            frames.invented_grain.reset();
        FrameReport frame_report;
        out.surface = add_frames(limit, frames, frame_report, where);
        out.report.limit_points = out.surface.position.size();
        out.report.limit_triangles = out.surface.triangle.size();
        out.report.repaired_normals = limit.repaired_normals;
        out.report.repaired_frames = frame_report.repaired;
        out.report.repaired_area_share = frame_report.repaired_area_share;
        find_repairs(out.report);
        if (options.strict)
            refuse_warnings(out.report, where);
        check_surface(out.surface, where);
        return out;
    });
}

LoadedGarment load(const std::filesystem::path &path, const Options &options,
                   const Progress &progress) {
    std::string extension = path.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension != ".obj")
        throw Error({"'" + extension + "' is not a mesh format that is read", path.string(),
                     "expected .obj"});
    progress("garment: read", 0.0);
    return load(read_obj(path), options, path.string(), progress);
}

} // namespace tsuya::garment

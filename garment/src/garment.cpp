#include "tsuya/garment/garment.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "load_steps.h"
#include "repair/mesh_repair.h"
#include "tsuya/garment/check.h"
#include "tsuya/garment/mesh_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

void check_options(const Options &options, const std::string &where) {
    if (!(options.metres_per_unit > 0.0) || !std::isfinite(options.metres_per_unit))
        throw Error({"the unit of length is " + std::to_string(options.metres_per_unit) + " m",
                     where + ": metres_per_unit", "expected a positive number"});
    if (options.metres_per_uv &&
        (!(*options.metres_per_uv > 0.0) || !std::isfinite(*options.metres_per_uv)))
        throw Error({"the UV scale is " + std::to_string(*options.metres_per_uv) + " m",
                     where + ": metres_per_uv", "expected a positive number"});
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
    Problems problems;
    for (const Finding &f : report.findings)
        problems.need(f.severity != Severity::warning, f.what, where, "strict: " + f.key);
    problems.throw_if_any();
}

/// An error about a mesh, named `mesh` where it has no other place, at the place of its file.
Error placed(const Error &error, const std::string &where) {
    std::vector<Problem> problems = error.problems();
    for (Problem &p : problems)
        if (p.where == "mesh")
            p.where = where;
    return Error(std::move(problems)).within(where);
}

/// Turns the grain of a panel to the threads that its material states, unless the caller did.
void use_hint(const FabricHint &hint, FrameOptions &frames, std::vector<Finding> &findings) {
    Finding finding{Severity::note, "fabric_hint", "", "",
                    "no fabric is made of it; name one for the panel"};
    finding.what = "material '" + hint.material + "' of panel '" + hint.panel + "' states";
    if (hint.anisotropy_strength > 0.0) {
        finding.what += " anisotropy " + std::to_string(hint.anisotropy_strength) +
                        ", so threads at " + std::to_string(glm::degrees(hint.thread_angle)) +
                        " degrees from +u";
        if (frames.grain.try_emplace(hint.panel, hint.grain()).second)
            finding.action = "the warp of this panel laid along its threads";
    }
    if (hint.sheen_colour)
        finding.what += hint.anisotropy_strength > 0.0 ? " and sheen" : " sheen";
    if (hint.anisotropy_strength > 0.0 || hint.sheen_colour)
        findings.push_back(std::move(finding));
}

std::vector<Finding> use_hints(const std::vector<FabricHint> &hints, FrameOptions &frames) {
    std::vector<Finding> findings;
    for (const FabricHint &hint : hints)
        use_hint(hint, frames, findings);
    return findings;
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

UpAxis up_axis(std::string_view name) {
    if (name == "y")
        return UpAxis::y;
    if (name == "z")
        return UpAxis::z;
    throw Error({"'" + std::string(name) + "' is not an axis that may be up", "up",
                 "expected one of: y, z"});
}

glm::dvec3 in_metres(const Options &options, const glm::dvec3 &point) {
    const glm::dvec3 p = options.metres_per_unit * point;
    return options.up == UpAxis::z ? glm::dvec3(p.x, p.z, -p.y) : p;
}

namespace {

LoadSteps run_steps(PolygonMesh mesh, const Options &options, const std::vector<Finding> &of_file,
                    const std::string &where, Further further, const Progress &progress) {
    check_indices(mesh, where);
    for (glm::dvec3 &p : mesh.position)
        p = in_metres(options, p);
    Prepared prepared = MeshRepair(std::move(mesh), options.seams, options.want_frames,
                                   options.frames.plain, progress)
                            .state_unit(options.unit_stated)
                            .run();
    if (options.want_frames) {
        prepared.report.metres_per_uv = choose_uv_scale(options.metres_per_uv, prepared.report);
    } else {
        prepared.mesh.uv.clear();
        std::fill(prepared.mesh.corner_uv.begin(), prepared.mesh.corner_uv.end(), -1);
    }
    LoadSteps steps{.recipe = std::move(prepared.positions), .frames = options.frames};
    steps.frames.metres_per_uv = prepared.report.metres_per_uv;
    if (!options.want_frames)
        steps.frames.invented_grain.reset();
    LimitMesh limit;
    if (further == Further::frames) {
        steps.subdivider.emplace(std::move(prepared.mesh), options.subdivide, progress);
        limit = steps.subdivider->evaluate(progress);
    } else {
        limit = subdivide(std::move(prepared.mesh), options.subdivide, progress);
    }
    const std::size_t repaired_normals = limit.repaired_normals;
    FrameReport frame_report;
    LoadedGarment &out = steps.garment;
    out.surface = add_frames(std::move(limit), steps.frames, frame_report, where, progress);
    out.report = std::move(prepared.report);
    out.report.limit_points = out.surface.position.size();
    out.report.limit_triangles = out.surface.triangle.size();
    out.report.repaired_normals = repaired_normals;
    out.report.repaired_frames = frame_report.repaired;
    out.report.repaired_area_share = frame_report.repaired_area_share;
    find_repairs(out.report);
    if (const auto upright = find_up_axis(out.report); upright && !options.up)
        out.report.findings.push_back(*upright);
    out.report.findings.insert(out.report.findings.end(), of_file.begin(), of_file.end());
    if (options.strict)
        refuse_warnings(out.report, where);
    check_surface(out.surface, where);
    return steps;
}

} // namespace

LoadSteps load_steps(MeshFile file, const Options &options, const std::string &where,
                     Further further, const Progress &progress) {
    check_options(options, where);
    Options with_hints = options;
    std::vector<Finding> findings = use_hints(file.hints, with_hints.frames);
    findings.insert(findings.begin(), file.findings.begin(), file.findings.end());
    try {
        LoadSteps steps =
            run_steps(std::move(file.mesh), with_hints, findings, where, further, progress);
        steps.garment.hints = std::move(file.hints);
        return steps;
    } catch (const Error &error) {
        throw placed(error, where);
    }
}

LoadedGarment load(PolygonMesh mesh, const Options &options, const std::string &where,
                   const Progress &progress) {
    return load(MeshFile{.mesh = std::move(mesh)}, options, where, progress);
}

LoadedGarment load(MeshFile file, const Options &options, const std::string &where,
                   const Progress &progress) {
    return load_steps(std::move(file), options, where, Further::none, progress).garment;
}

LoadedGarment load(const std::filesystem::path &path, const Options &options,
                   const Progress &progress) {
    return load(read_mesh(path, progress), options, path.string(), progress);
}

} // namespace tsuya::garment

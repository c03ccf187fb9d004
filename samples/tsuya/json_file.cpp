#include "json_file.h"

#include <cmath>

#include "tsuya/garment/report.h"
#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/render.h"

namespace tsuya::program {
namespace {

Json json_of(const glm::dvec3 &v) { return Json::array({v.x, v.y, v.z}); }

Json json_of(const garment::Percentiles &p) {
    return {{"p5", p.p5}, {"p50", p.p50}, {"p95", p.p95}};
}

Json json_in_degrees(const garment::Percentiles &p) {
    return {{"p5", degrees_of(p.p5)}, {"p50", degrees_of(p.p50)}, {"p95", degrees_of(p.p95)}};
}

Json json_of(const garment::ManifoldReport &m) {
    return {{"degenerate_faces", m.degenerate_faces},
            {"duplicate_faces", m.duplicate_faces},
            {"non_manifold_edges", m.non_manifold_edges},
            {"non_manifold_vertices", m.non_manifold_vertices},
            {"flipped_faces", m.flipped_faces},
            {"unorientable_edges", m.unorientable_edges},
            {"detached_faces", m.detached_faces},
            {"isolated_vertices", m.isolated_vertices}};
}

Json json_of(const garment::SeamReport &s) {
    return {{"tolerance", s.tolerance},
            {"boundary_before", s.boundary_before},
            {"boundary_after", s.boundary_after},
            {"joined", s.joined},
            {"splits", s.splits},
            {"slits", s.slits},
            {"collapsed_edges", s.collapsed_edges},
            {"largest_gap", s.largest_gap},
            {"unresolved", s.unresolved}};
}

Json json_of(const std::vector<garment::PanelReport> &panels) {
    Json list = Json::array();
    for (const garment::PanelReport &p : panels)
        list.push_back({{"name", p.name},
                        {"object", p.label.object},
                        {"group", p.label.group},
                        {"material", p.label.material},
                        {"island", p.label.island},
                        {"lower_m", json_of(p.lower)},
                        {"upper_m", json_of(p.upper)},
                        {"faces", p.faces},
                        {"area", p.area},
                        {"warp", json_of(p.warp)},
                        {"warp_to_vertical_deg", degrees_of(p.warp_to_vertical)}});
    return list;
}

Json json_of(const std::vector<garment::Finding> &findings) {
    Json list = Json::array();
    for (const garment::Finding &f : findings)
        list.push_back({{"severity", f.severity == garment::Severity::warning ? "warning" : "note"},
                        {"key", f.key},
                        {"what", f.what},
                        {"where", f.where},
                        {"action", f.action}});
    return list;
}

Json json_of(const std::vector<Feature> &features) {
    Json list = Json::array();
    for (const Feature &feature : features) {
        const std::optional<Saving> &saves = feature.saves;
        list.push_back({{"name", feature.name},
                        {"on", feature.on},
                        {"why", feature.why},
                        {"saves", saves ? Json{{"estimated_share_of_sample", saves->of_sample},
                                               {"estimated_seconds", saves->seconds},
                                               {"bytes", saves->bytes}}
                                        : Json()}});
    }
    return list;
}

} // namespace

Json json_of(const RenderStats &stats, const Plan &plan) {
    Json phases = Json::array(), skipped = Json::array();
    double trace_cpu_seconds = 0;
    for (const Phase &phase : stats.phases) {
        phases.push_back(
            {{"name", phase.name}, {"seconds", phase.seconds}, {"cpu_seconds", phase.cpu_seconds}});
        if (phase.name == "trace")
            trace_cpu_seconds = phase.cpu_seconds;
    }
    for (const Feature &feature : plan.features)
        if (!feature.on && feature.saves)
            skipped.push_back(
                {{"what", feature.name + ": " + feature.why}, {"saves", text_of(*feature.saves)}});
    const auto rate = [&](std::uint64_t count) {
        return trace_cpu_seconds > 0 ? Json(static_cast<double>(count) / trace_cpu_seconds)
                                     : Json();
    };
    const PreparedUse &prepared = stats.prepared;
    return {{"schema", "tsuya-render-stats 1"},
            {"samples_per_pixel", stats.samples_per_pixel},
            {"seconds", stats.seconds},
            {"build_seconds", stats.build_seconds},
            {"relative_error", stats.relative_error},
            {"error_asked", stats.error_asked ? Json(*stats.error_asked) : Json()},
            {"error_reached_share", stats.error_reached_share},
            {"denoise_change", stats.denoise_change ? Json(*stats.denoise_change) : Json()},
            {"widening_change", stats.widening_change ? Json(*stats.widening_change) : Json()},
            {"rays", stats.rays.all()},
            {"camera_rays", stats.rays.camera},
            {"shadow_rays", stats.rays.shadow},
            {"bounce_rays", stats.rays.bounce},
            {"not_finite", stats.not_finite},
            {"triangles", stats.triangles},
            {"samples", stats.samples},
            {"phases", phases},
            {"samples_per_cpu_second", rate(stats.samples)},
            {"rays_per_cpu_second", rate(stats.rays.all())},
            {"peak_memory_bytes", stats.peak_memory_bytes},
            {"objects_built", prepared.objects_built},
            {"objects_kept", prepared.objects_kept},
            {"tables_made", prepared.tables.made},
            {"tables_read", prepared.tables.read},
            {"tables_shared", prepared.tables.shared},
            {"cache_problem",
             prepared.tables.cache_problem.empty() ? Json() : Json(prepared.tables.cache_problem)},
            {"skipped", skipped},
            {"features", json_of(plan.features)},
            {"interrupted", stats.interrupted}};
}

Json json_of(const Plan &plan) {
    Json dyes = Json::array();
    for (const DyeVariable &dye : plan.dyes)
        dyes.push_back(dye.name);
    return {{"schema", "tsuya-render-plan 1"},
            {"channels", plan.channels},
            {"depths_of_dyes", dyes},
            {"max_bounces", plan.max_bounces},
            {"lights", plan.lights.size()},
            {"environment", plan.environment},
            {"features", json_of(plan.features)}};
}

Json json_of(const garment::Report &r) {
    Json openings = Json::array();
    for (const garment::BoundaryLoop &loop : r.openings)
        openings.push_back(
            {{"edges", loop.edges}, {"length", loop.length}, {"centre", json_of(loop.centre)}});
    return {{"schema", "tsuya-garment-check 1"},
            {"vertices", r.vertices},
            {"uvs", r.uvs},
            {"faces", r.faces},
            {"triangles", r.triangles},
            {"quads", r.quads},
            {"ngons", r.ngons},
            {"concave_faces", r.concave_faces},
            {"crossed_faces", r.crossed_faces},
            {"panels", r.panels},
            {"parts", r.parts},
            {"parts_before", r.parts_before},
            {"loops_before", r.loops_before},
            {"openings", openings},
            {"file", json_of(r.file)},
            {"joined", json_of(r.joined)},
            {"seams", json_of(r.seams)},
            {"uv_islands", r.uv_islands},
            {"mirrored_islands", r.mirrored_islands},
            {"mirrored_faces", r.mirrored_faces},
            {"faces_without_uv", r.faces_without_uv},
            {"faces_without_uv_area", r.faces_without_uv_area},
            {"area_without_uv", r.area_without_uv},
            {"metres_per_uv_weft", json_of(r.metres_per_uv_weft)},
            {"metres_per_uv_warp", json_of(r.metres_per_uv_warp)},
            {"warp_weft_angle_deg", json_in_degrees(r.warp_weft_angle)},
            {"panel", json_of(r.panel)},
            {"island", json_of(r.island)},
            {"lower", json_of(r.lower)},
            {"upper", json_of(r.upper)},
            {"area", r.area},
            {"findings", json_of(r.findings)}};
}

Json json_of(const ErrorMeasures &error) {
    Json json = Json::object();
    for (const NamedMeasure &measure : error_measures()) {
        const std::optional<double> &value = error.*measure.value;
        json[std::string(measure.name)] = value && std::isfinite(*value) ? Json(*value) : Json();
    }
    return json;
}

double degrees_of(double angle) {
    constexpr double kSteps = 1e6;
    return std::round(angle / kDegree * kSteps) / kSteps;
}

void write_json(const std::filesystem::path &file, const Json &json) {
    write_file(file, json.text() + "\n");
}

} // namespace tsuya::program

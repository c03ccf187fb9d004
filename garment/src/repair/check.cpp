#include "tsuya/garment/check.h"

#include "mesh/edges.h"
#include "repair/measure.h"
#include "repair/topology.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Above this number of UV islands they do not stand for panels (a file with one UV a corner).
constexpr std::uint32_t kMaxIslandPanels = 256;

void name_panels(PolygonMesh &mesh) {
    std::uint32_t islands = 0;
    if (!mesh.panel_name.empty() || mesh.uv.empty())
        return;
    uv_islands(mesh, islands);
    if (islands <= kMaxIslandPanels)
        panels_from_uv_islands(mesh);
}

/// Half-edges take a time that grows with the square of the faces about a vertex.
void check_valence(const PolygonMesh &mesh) {
    std::vector<std::uint32_t> valence(mesh.position.size(), 0);
    for (const std::uint32_t v : mesh.corner_position)
        if (++valence[v] >= kMaxValence)
            throw Error({"vertex " + std::to_string(v) + " joins too many faces", "mesh",
                         "expected fewer than " + std::to_string(kMaxValence)});
}

} // namespace

Prepared prepare(const PolygonMesh &metres, const SeamOptions &options) {
    check_indices(metres, "mesh");
    Prepared out;
    Report &report = out.report;
    measure_file(metres, report);
    // The file by itself: panels, and what is wrong with them.
    PolygonMesh panels = make_manifold(metres, report.file, out.positions);
    if (panels.face_count() == 0)
        throw Error({"no face is left after degenerate faces were dropped", "mesh",
                     "expected faces of 3 different vertices or more"});
    name_panels(panels);
    check_valence(panels);
    {
        const HalfEdgeMesh half_edges = make_half_edges(panels);
        report.parts_before = count_parts(half_edges);
        report.loops_before = boundary_runs(half_edges).size();
    }
    // The garment: panels joined along their seams.
    out.mesh = join_seams(panels, options, report.seams, report.joined, out.positions);
    if (out.mesh.face_count() == 0)
        throw Error({"no face is left after seams were joined", "mesh",
                     "expected faces larger than the tolerance of seams"});
    const HalfEdgeMesh half_edges = make_half_edges(out.mesh);
    report.parts = count_parts(half_edges);
    report.openings = measure_loops(half_edges);
    measure_uv(out.mesh, report);
    find_all(metres, report);
    return out;
}

Report check(const PolygonMesh &metres, const SeamOptions &options) {
    return prepare(metres, options).report;
}

} // namespace tsuya::garment

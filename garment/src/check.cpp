#include "tsuya/garment/check.h"

#include "measure.h"
#include "topology.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

Prepared prepare(const PolygonMesh &metres, const SeamOptions &options) {
    check_indices(metres, "mesh");
    Prepared out;
    Report &report = out.report;
    measure_file(metres, report);
    // The file by itself: panels, and what is wrong with them.
    const PolygonMesh panels = make_manifold(metres, report.file);
    if (panels.face_count() == 0)
        throw Error({"no face is left after degenerate faces were dropped", "mesh",
                     "expected faces of 3 different vertices or more"});
    {
        const HalfEdgeMesh half_edges = make_half_edges(panels);
        report.parts_before = count_parts(half_edges);
        report.loops_before = boundary_runs(half_edges).size();
    }
    // The garment: panels joined along their seams.
    out.mesh = join_seams(panels, options, report.seams, report.joined);
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

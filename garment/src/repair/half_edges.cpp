// OpenMesh appends vertices that are not initialised before it sets them, which g++ sees with the
// sanitizers on.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "repair/half_edges.h"

#include <algorithm>

#include "mesh/stop.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

HalfEdgeMesh make_half_edges(const PolygonMesh &mesh, const Progress &progress) {
    HalfEdgeMesh result;
    result.reserve(mesh.position.size(), mesh.corner_position.size() / 2 + mesh.position.size(),
                   mesh.face_count());
    for (std::size_t v = 0; v < mesh.position.size(); ++v)
        result.new_vertex();
    std::vector<HalfEdgeMesh::VertexHandle> face;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        look_at_stop(progress, f);
        face.clear();
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            face.emplace_back(static_cast<int>(mesh.corner_position[c]));
        if (!result.add_face(face).is_valid())
            throw Error({"face " + std::to_string(f) + " makes the mesh non-manifold", "mesh",
                         "expected a manifold mesh, see make_manifold"});
    }
    return result;
}

std::vector<BoundaryRun> boundary_runs(const HalfEdgeMesh &half_edges) {
    std::vector<BoundaryRun> runs;
    std::vector<bool> seen(half_edges.n_halfedges(), false);
    for (const auto start : half_edges.halfedges()) {
        if (!half_edges.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())])
            continue;
        BoundaryRun run;
        for (HalfEdgeMesh::HalfedgeHandle h = start; !seen[static_cast<std::size_t>(h.idx())];
             h = half_edges.next_halfedge_handle(h)) {
            seen[static_cast<std::size_t>(h.idx())] = true;
            run.push_back(h);
        }
        runs.push_back(std::move(run));
    }
    return runs;
}

std::uint32_t start_of(const HalfEdgeMesh &half_edges, HalfEdgeMesh::HalfedgeHandle h) {
    return static_cast<std::uint32_t>(half_edges.from_vertex_handle(h).idx());
}

std::vector<BoundaryLoop> measure_loops(const PolygonMesh &mesh, const HalfEdgeMesh &half_edges) {
    std::vector<BoundaryLoop> loops;
    for (const BoundaryRun &run : boundary_runs(half_edges)) {
        BoundaryLoop loop{.edges = run.size()};
        for (std::size_t i = 0; i < run.size(); ++i) {
            const glm::dvec3 &a = mesh.position[start_of(half_edges, run[i])];
            const glm::dvec3 &b = mesh.position[start_of(half_edges, run[(i + 1) % run.size()])];
            loop.length += glm::distance(a, b);
            loop.centre += a / static_cast<double>(run.size());
        }
        loops.push_back(loop);
    }
    std::stable_sort(loops.begin(), loops.end(), [](const BoundaryLoop &a, const BoundaryLoop &b) {
        return a.length > b.length;
    });
    return loops;
}

} // namespace tsuya::garment

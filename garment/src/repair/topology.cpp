// OpenMesh appends vertices that are not initialised before it sets them, which g++ sees with the
// sanitizers on.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "repair/topology.h"

#include <algorithm>

#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

glm::dvec3 point_of(const HalfEdgeMesh &mesh, HalfEdgeMesh::VertexHandle v) {
    const auto &p = mesh.point(v);
    return {p[0], p[1], p[2]};
}

} // namespace

HalfEdgeMesh make_half_edges(const PolygonMesh &mesh) {
    HalfEdgeMesh result;
    result.reserve(mesh.position.size(), mesh.corner_position.size() / 2 + mesh.position.size(),
                   mesh.face_count());
    for (const glm::dvec3 &p : mesh.position)
        result.add_vertex({p.x, p.y, p.z});
    std::vector<HalfEdgeMesh::VertexHandle> face;
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        face.clear();
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            face.emplace_back(static_cast<int>(mesh.corner_position[c]));
        if (!result.add_face(face).is_valid())
            throw Error({"face " + std::to_string(f) + " makes the mesh non-manifold", "mesh",
                         "expected a manifold mesh, see make_manifold"});
    }
    return result;
}

std::vector<BoundaryRun> boundary_runs(const HalfEdgeMesh &mesh) {
    std::vector<BoundaryRun> runs;
    std::vector<bool> seen(mesh.n_halfedges(), false);
    for (const auto start : mesh.halfedges()) {
        if (!mesh.is_boundary(start) || seen[static_cast<std::size_t>(start.idx())])
            continue;
        BoundaryRun run;
        for (HalfEdgeMesh::HalfedgeHandle h = start; !seen[static_cast<std::size_t>(h.idx())];
             h = mesh.next_halfedge_handle(h)) {
            seen[static_cast<std::size_t>(h.idx())] = true;
            run.push_back(h);
        }
        runs.push_back(std::move(run));
    }
    return runs;
}

std::vector<BoundaryLoop> measure_loops(const HalfEdgeMesh &mesh) {
    std::vector<BoundaryLoop> loops;
    for (const BoundaryRun &run : boundary_runs(mesh)) {
        BoundaryLoop loop{.edges = run.size()};
        for (const auto h : run) {
            const glm::dvec3 a = point_of(mesh, mesh.from_vertex_handle(h));
            loop.length += glm::distance(a, point_of(mesh, mesh.to_vertex_handle(h)));
            loop.centre += a / static_cast<double>(run.size());
        }
        loops.push_back(loop);
    }
    std::stable_sort(loops.begin(), loops.end(), [](const BoundaryLoop &a, const BoundaryLoop &b) {
        return a.length > b.length;
    });
    return loops;
}

std::size_t count_parts(const HalfEdgeMesh &mesh) {
    std::size_t parts = 0;
    std::vector<bool> seen(mesh.n_faces(), false);
    std::vector<HalfEdgeMesh::FaceHandle> open;
    for (const auto seed : mesh.faces()) {
        if (seen[static_cast<std::size_t>(seed.idx())])
            continue;
        ++parts;
        seen[static_cast<std::size_t>(seed.idx())] = true;
        open.push_back(seed);
        while (!open.empty()) {
            const auto face = open.back();
            open.pop_back();
            for (const auto other : mesh.ff_range(face))
                if (!seen[static_cast<std::size_t>(other.idx())]) {
                    seen[static_cast<std::size_t>(other.idx())] = true;
                    open.push_back(other);
                }
        }
    }
    return parts;
}

} // namespace tsuya::garment

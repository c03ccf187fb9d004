// Narrow gaps that are left along seams.

#include "mesh/distance.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

/// True for a loop as narrow as `width`: all of its vertices but the two tips lie that near to an
/// edge of the other side, which runs against the loop there. Edges that run on with it, as in a
/// hem of fine edges, say nothing.
bool is_slit(const std::vector<glm::dvec3> &loop, double width) {
    constexpr std::size_t kTips = 2, kMostEdges = 4096; // the time grows with the square
    const std::size_t n = loop.size();
    if (n > kMostEdges)
        return false;
    std::size_t wide = 0;
    for (std::size_t i = 0; i < n && wide <= kTips; ++i) {
        bool near = false;
        const glm::dvec3 run = loop[(i + 1) % n] - loop[(i + n - 1) % n];
        for (std::size_t k = 1; k + 1 < n && !near; ++k) {
            const glm::dvec3 &from = loop[(i + k) % n], &to = loop[(i + k + 1) % n];
            near = segment_distance(loop[i], from, to) <= width && glm::dot(run, to - from) < 0.0;
        }
        wide += !near;
    }
    return wide <= kTips && wide < n;
}

} // namespace

Slits MeshRepair::find_slits() {
    Slits slits{.vertices = {std::vector<bool>(mesh_.position.size(), false)}};
    for (const BoundaryRun &run : boundary_runs(half_edges())) {
        std::vector<glm::dvec3> loop;
        for (const auto h : run)
            loop.push_back(mesh_.position[start_of(half_edges(), h)]);
        if (!is_slit(loop, options_.slit_width))
            continue;
        ++slits.count;
        for (const auto h : run)
            slits.vertices.member[start_of(half_edges(), h)] = true;
    }
    return slits;
}

} // namespace tsuya::garment

#include "limit/creases.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "mesh/edges.h"
#include "mesh/face_plane.h"

namespace tsuya::garment {
namespace {

// Of edges in one plane: straight down to the finest level.
constexpr double kStraight = 9.0;

using FacePair = std::pair<std::uint32_t, std::uint32_t>;

// Faces of all corners of a vertex, a face once for each corner.
std::vector<std::vector<std::uint32_t>> faces_of_vertices(const PolygonMesh &mesh) {
    std::vector<std::vector<std::uint32_t>> faces(mesh.position.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            faces[mesh.corner_position[c]].push_back(static_cast<std::uint32_t>(f));
    return faces;
}

// Vertices within two faces of a pair of faces that share more than a vertex or an edge, or of a
// face that has a vertex twice.
std::vector<bool> near_tangles(const PolygonMesh &mesh, const EdgeTable &edges) {
    const auto faces = faces_of_vertices(mesh);
    std::map<FacePair, int> vertices, sides;
    for (const std::vector<std::uint32_t> &around : faces)
        for (std::size_t i = 0; i < around.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                ++vertices[std::minmax(around[i], around[j])];
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() == 2)
            ++sides[std::minmax(uses[0].face, uses[1].face)];
    });
    std::vector<bool> tangled(mesh.face_count()), near(mesh.position.size());
    for (const auto &[pair, count] : vertices) {
        const auto found = sides.find(pair);
        const int shared_sides = found == sides.end() ? 0 : found->second;
        if (pair.first == pair.second || count > 2 || count != 1 + shared_sides)
            tangled[pair.first] = tangled[pair.second] = true;
    }
    const auto mark = [&](const std::vector<bool> &marked) {
        for (std::size_t f = 0; f < marked.size(); ++f)
            for (std::uint32_t c = mesh.face_offset[f]; marked[f] && c < mesh.face_offset[f + 1];
                 ++c)
                near[mesh.corner_position[c]] = true;
    };
    mark(tangled);
    for (int ring = 0; ring < 2; ++ring) {
        for (std::size_t v = 0; v < near.size(); ++v)
            for (const std::uint32_t f : faces[v])
                tangled[f] = tangled[f] || near[v];
        mark(tangled);
    }
    return near;
}

} // namespace

Creases find_creases(const PolygonMesh &mesh, const SubdivideOptions &options) {
    Creases creases;
    const bool creased = options.seam_crease > 0.0 || options.fold_crease > 0.0;
    if (!creased && mesh.hem_corner.empty() && mesh.straight_edge.empty())
        return creases;
    const EdgeTable edges(mesh);
    const std::vector<bool> smooth = near_tangles(mesh, edges);
    const auto add = [&](std::uint32_t a, std::uint32_t b, double sharpness) {
        creases.ends.push_back(static_cast<int>(a));
        creases.ends.push_back(static_cast<int>(b));
        creases.sharpness.push_back(static_cast<float>(sharpness));
    };
    for (const glm::uvec2 &edge : mesh.straight_edge)
        if (!smooth[edge.x] && !smooth[edge.y])
            add(edge.x, edge.y, kStraight);
    for (const std::uint32_t v : mesh.hem_corner)
        if (!smooth[v])
            creases.corners.push_back(static_cast<int>(v));
    if (!creased)
        return creases;
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() != 2 || smooth[uses[0].low] || smooth[uses[0].high])
            return;
        const EdgeUse &a = uses[0], &b = uses[1];
        double sharpness = 0.0;
        if (uv_at(mesh, a, a.low) != uv_at(mesh, b, b.low) ||
            uv_at(mesh, a, a.high) != uv_at(mesh, b, b.high))
            sharpness = options.seam_crease;
        const FacePlane plane_a = face_plane(mesh, a.face), plane_b = face_plane(mesh, b.face);
        if (plane_a.area > 0.0 && plane_b.area > 0.0 &&
            glm::dot(plane_a.normal, plane_b.normal) < std::cos(options.fold_angle))
            sharpness = std::max(sharpness, options.fold_crease);
        if (sharpness <= 0.0)
            return;
        add(a.low, a.high, sharpness);
    });
    return creases;
}

} // namespace tsuya::garment

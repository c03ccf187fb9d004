#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesh/face_plane.h"
#include "mesh/stop.h"
#include "repair/ears.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// A face in its own plane, counter-clockwise; empty where it has no area.
std::vector<glm::dvec2> flat_polygon(const PolygonMesh &mesh, std::size_t f) {
    const FacePlane plane = face_plane(mesh, f);
    std::vector<glm::dvec2> polygon;
    if (!(plane.area > 0.0))
        return polygon;
    const glm::dvec3 side =
        std::abs(plane.normal.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(side, plane.normal));
    const glm::dvec3 y = glm::cross(plane.normal, x);
    const glm::dvec3 origin = mesh.position[mesh.corner_position[mesh.face_offset[f]]];
    for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
        const glm::dvec3 p = mesh.position[mesh.corner_position[c]] - origin;
        polygon.emplace_back(glm::dot(p, x), glm::dot(p, y));
    }
    return polygon;
}

std::set<Edge> edges_of(const PolygonMesh &mesh) {
    std::set<Edge> edges;
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            edges.insert(
                std::minmax(mesh.corner_position[c], mesh.corner_position[mesh.next(f, c)]));
    return edges;
}

/// True where no edge between the triangles of a face joins two vertices that are joined already.
bool take_new_edges(const PolygonMesh &mesh, std::size_t f, const Triangles &triangles,
                    std::set<Edge> &edges) {
    const std::uint32_t first = mesh.face_offset[f], corners = mesh.face_size(f);
    std::set<Edge> added;
    for (const auto &triangle : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const auto [a, b] = std::minmax(triangle[i], triangle[(i + 1) % 3]);
            if (b - a == 1 || b - a == corners - 1)
                continue;
            const Edge edge =
                std::minmax(mesh.corner_position[first + a], mesh.corner_position[first + b]);
            if (edges.contains(edge))
                return false;
            added.insert(edge);
        }
    edges.insert(added.begin(), added.end());
    return true;
}

} // namespace

void MeshRepair::divide_concave_faces() {
    std::vector<std::pair<std::size_t, Triangles>> divided;
    std::set<Edge> edges;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        look_at_stop(progress_, f);
        if (mesh_.face_size(f) < 4)
            continue;
        const std::vector<glm::dvec2> polygon = flat_polygon(mesh_, f);
        if (polygon.empty() || !is_concave(polygon))
            continue;
        if (edges.empty())
            edges = edges_of(mesh_);
        std::optional<Triangles> triangles = clip_ears(polygon);
        const bool good = triangles && take_new_edges(mesh_, f, *triangles, edges);
        ++(good ? report_.concave_faces : report_.crossed_faces);
        keep_place(report_.first_place, good ? "concave_faces" : "crossed_faces", first_point(f));
        if (good)
            divided.emplace_back(f, std::move(*triangles));
    }
    if (divided.empty())
        return;
    keep_hem_corners(divided);
    keep_straight_edges(divided);
    replace_faces(divided);
    faces_changed();
}

void MeshRepair::keep_hem_corners(const Divided &divided) {
    std::vector<std::uint32_t> faces(mesh_.position.size(), 0);
    for (const std::uint32_t v : mesh_.corner_position)
        ++faces[v];
    for (const auto &[f, triangles] : divided)
        for (std::uint32_t c = mesh_.face_offset[f]; c < mesh_.face_offset[f + 1]; ++c)
            if (faces[mesh_.corner_position[c]] == 1)
                mesh_.hem_corner.push_back(mesh_.corner_position[c]);
}

void MeshRepair::keep_straight_edges(const Divided &divided) {
    constexpr double kOnePlane = 0.995; // cosine of the angle between the normals
    for (const auto &[f, triangles] : divided) {
        const auto vertex = [&, first = mesh_.face_offset[f]](std::uint32_t corner) {
            return mesh_.corner_position[first + corner];
        };
        const auto normal = [&](const std::array<std::uint32_t, 3> &t) {
            const glm::dvec3 a = mesh_.position[vertex(t[0])];
            return glm::normalize(
                glm::cross(mesh_.position[vertex(t[1])] - a, mesh_.position[vertex(t[2])] - a));
        };
        std::map<Edge, glm::dvec3> first_side;
        for (const auto &triangle : triangles)
            for (std::size_t i = 0; i < 3; ++i) {
                const std::uint32_t a = vertex(triangle[i]), b = vertex(triangle[(i + 1) % 3]);
                const auto [at, added] =
                    first_side.try_emplace(std::minmax(a, b), normal(triangle));
                if (!added && glm::dot(at->second, normal(triangle)) > kOnePlane)
                    mesh_.straight_edge.emplace_back(a, b);
            }
    }
}

void MeshRepair::replace_faces(const Divided &divided) {
    PolygonMesh out;
    const auto copy = [&](std::size_t f, std::uint32_t corner) {
        const std::uint32_t c = mesh_.face_offset[f] + corner;
        out.corner_position.push_back(mesh_.corner_position[c]);
        out.corner_uv.push_back(mesh_.corner_uv[c]);
    };
    const auto end_face = [&](std::size_t f) {
        out.face_offset.push_back(static_cast<std::uint32_t>(out.corner_position.size()));
        out.face_panel.push_back(mesh_.face_panel[f]);
    };
    auto next = divided.begin();
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        if (next == divided.end() || next->first != f) {
            for (std::uint32_t c = 0; c < mesh_.face_size(f); ++c)
                copy(f, c);
            end_face(f);
            continue;
        }
        for (const auto &triangle : next->second) {
            for (const std::uint32_t c : triangle)
                copy(f, c);
            end_face(f);
        }
        ++next;
    }
    mesh_.face_offset = std::move(out.face_offset);
    mesh_.corner_position = std::move(out.corner_position);
    mesh_.corner_uv = std::move(out.corner_uv);
    mesh_.face_panel = std::move(out.face_panel);
}

} // namespace tsuya::garment

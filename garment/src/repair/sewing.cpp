// Vertices become one, and are put into edges.

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "mesh/stop.h"
#include "repair/mesh_repair.h"
#include "repair/split_triangle.h"

namespace tsuya::garment {
namespace {

/// A face with its new corners, and where they lie in the plane of a triangle.
struct GrownFace {
    std::vector<std::uint32_t> vertex;
    std::vector<std::int32_t> uv;
    std::vector<glm::dvec2> plane;
    std::vector<std::uint32_t> origin;
};

/// The corners of a triangle in its own plane.
std::array<glm::dvec2, 3> flatten(const PolygonMesh &mesh, std::size_t f) {
    const std::uint32_t *v = &mesh.corner_position[mesh.face_offset[f]];
    const glm::dvec3 ab = mesh.position[v[1]] - mesh.position[v[0]];
    const glm::dvec3 ac = mesh.position[v[2]] - mesh.position[v[0]];
    const double length = glm::length(ab);
    if (!(length > 0.0))
        return {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)};
    return {glm::dvec2(0, 0), glm::dvec2(length, 0),
            glm::dvec2(glm::dot(ac, ab) / length, glm::length(glm::cross(ab, ac)) / length)};
}

/// \param uvs gets those of new corners
GrownFace grow_face(const PolygonMesh &mesh, const std::vector<std::uint32_t> &origin,
                    std::size_t f, std::span<const Insertion> insertions,
                    std::vector<glm::dvec2> &uvs) {
    GrownFace grown;
    const std::uint32_t first = mesh.face_offset[f];
    const auto corners = mesh.face_size(f) == 3 ? flatten(mesh, f) : std::array<glm::dvec2, 3>{};
    for (std::uint32_t c = first; c < mesh.face_offset[f + 1]; ++c) {
        const std::uint32_t n = mesh.next(f, c);
        const glm::dvec2 a = corners[(c - first) % 3], b = corners[(n - first) % 3];
        grown.vertex.push_back(mesh.corner_position[c]);
        grown.uv.push_back(mesh.corner_uv[c]);
        grown.plane.push_back(a);
        grown.origin.push_back(origin[c]);
        for (const Insertion &i : insertions) {
            if (i.corner != c)
                continue;
            grown.origin.push_back(i.origin);
            grown.vertex.push_back(i.vertex);
            grown.plane.push_back(a + i.t * (b - a));
            if (mesh.corner_uv[c] < 0 || mesh.corner_uv[n] < 0) {
                grown.uv.push_back(-1);
                continue;
            }
            const glm::dvec2 s = uvs[static_cast<std::size_t>(mesh.corner_uv[c])];
            const glm::dvec2 e = uvs[static_cast<std::size_t>(mesh.corner_uv[n])];
            grown.uv.push_back(static_cast<std::int32_t>(uvs.size()));
            uvs.push_back((1.0 - i.t) * s + i.t * e);
        }
    }
    return grown;
}

} // namespace

void MeshRepair::apply(Pairing pairing) {
    SeamReport &report = report_.seams;
    report.largest_gap = std::max(report.largest_gap, pairing.largest_gap);
    if (!pairing.clusters.empty()) {
        std::vector<std::uint32_t> into(mesh_.position.size());
        std::iota(into.begin(), into.end(), 0u);
        for (const std::vector<std::uint32_t> &cluster : pairing.clusters) {
            report.joined += cluster.size() - 1;
            recipe_.mean(mesh_.position, cluster[0], cluster);
            layers_.join(cluster[0], cluster);
            for (const std::uint32_t v : cluster)
                into[v] = cluster[0];
        }
        rename_vertices(into);
    }
    if (pairing.insertions.empty())
        return;
    for (Insertion &i : pairing.insertions) {
        i.origin = sewing_.next_origin++;
        report.largest_gap = std::max(report.largest_gap, i.distance);
    }
    report.splits += pairing.insertions.size();
    insert_vertices(pairing.insertions);
}

void MeshRepair::rename_vertices(const std::vector<std::uint32_t> &into) {
    for (std::uint32_t &v : mesh_.corner_position)
        v = into[v];
    faces_changed();
}

void MeshRepair::insert_vertices(const std::vector<Insertion> &insertions) {
    PolygonMesh out;
    std::vector<std::uint32_t> origin;
    std::size_t next = 0;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        look_at_stop(progress_, f);
        const std::size_t first = next;
        while (next < insertions.size() && insertions[next].corner < mesh_.face_offset[f + 1])
            ++next;
        if (next == first) {
            const auto begin = mesh_.face_offset[f], end = mesh_.face_offset[f + 1];
            const auto copy = [&](auto &to, const auto &from) {
                to.insert(to.end(), from.begin() + begin, from.begin() + end);
            };
            copy(out.corner_position, mesh_.corner_position);
            copy(out.corner_uv, mesh_.corner_uv);
            copy(origin, sewing_.origin);
            out.face_offset.push_back(static_cast<std::uint32_t>(out.corner_position.size()));
            out.face_panel.push_back(mesh_.face_panel[f]);
            continue;
        }
        const GrownFace grown = grow_face(
            mesh_, sewing_.origin, f, std::span(insertions).subspan(first, next - first), mesh_.uv);
        if (!sewing_.triangles) {
            out.add_face(grown.vertex, grown.uv, mesh_.face_panel[f]);
            origin.insert(origin.end(), grown.origin.begin(), grown.origin.end());
            continue;
        }
        for (const auto &[a, b, c] : split_triangle(grown.plane)) {
            out.add_face({grown.vertex[a], grown.vertex[b], grown.vertex[c]},
                         {grown.uv[a], grown.uv[b], grown.uv[c]}, mesh_.face_panel[f]);
            origin.insert(origin.end(), {grown.origin[a], grown.origin[b], grown.origin[c]});
        }
    }
    mesh_.face_offset = std::move(out.face_offset);
    mesh_.corner_position = std::move(out.corner_position);
    mesh_.corner_uv = std::move(out.corner_uv);
    mesh_.face_panel = std::move(out.face_panel);
    sewing_.origin = std::move(origin);
    faces_changed();
}

void MeshRepair::halve_coincident_edges() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> middles;
    std::vector<Insertion> insertions;
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() < 3)
            return;
        const auto origin = [&](const EdgeUse &use) {
            return std::pair(sewing_.origin[corner_at(mesh_, use, use.low)],
                             sewing_.origin[corner_at(mesh_, use, use.high)]);
        };
        for (std::size_t i = 0; i < uses.size(); ++i)
            for (std::size_t j = i + 1; j < uses.size(); ++j) {
                if (origin(uses[i]) != origin(uses[j]))
                    continue;
                const auto middle =
                    static_cast<std::uint32_t>(mesh_.position.size() + middles.size());
                middles.emplace_back(uses[i].low, uses[i].high);
                for (const EdgeUse &use : {uses[i], uses[j]})
                    insertions.push_back({use.corner, 0.5, middle, 0.0, sewing_.next_origin});
                ++sewing_.next_origin;
            }
    });
    if (insertions.empty())
        return;
    for (const auto &[a, b] : middles)
        recipe_.append_middle(mesh_.position, a, b);
    std::sort(insertions.begin(), insertions.end(),
              [](const Insertion &a, const Insertion &b) { return a.corner < b.corner; });
    insert_vertices(insertions);
    share_equal_uvs(mesh_);
}

std::size_t MeshRepair::collapse_short_edges(double tolerance, const VertexSet &allowed) {
    // Every vertex takes part in one collapse at most, so that none moves far.
    std::vector<std::uint32_t> into(mesh_.position.size());
    std::iota(into.begin(), into.end(), 0u);
    std::vector<bool> used(mesh_.position.size(), false);
    std::size_t count = 0;
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        const std::uint32_t a = uses[0].low, b = uses[0].high;
        if (!allowed.has(a) || !allowed.has(b) || used[a] || used[b] ||
            glm::distance(mesh_.position[a], mesh_.position[b]) > tolerance)
            return;
        used[a] = used[b] = true;
        into[b] = a;
        recipe_.mean(mesh_.position, a, {a, b});
        ++count;
    });
    if (count == 0)
        return 0;
    rename_vertices(into);
    return count;
}

} // namespace tsuya::garment

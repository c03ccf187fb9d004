#include <algorithm>
#include <bit>
#include <limits>

#include "mesh/edges.h"
#include "repair/fans.h"
#include "tsuya/garment/seams.h"

namespace tsuya::garment {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

glm::dvec3 first_point(const PolygonMesh &mesh, std::size_t f) {
    return mesh.position[mesh.corner_position[mesh.face_offset[f]]];
}

/// Drops repeated corners that follow each other, faces that keep fewer than 3 different vertices
/// or name a vertex twice, and faces with the vertices of an earlier one.
PolygonMesh drop_faces(const PolygonMesh &mesh, ManifoldReport &report) {
    PolygonMesh out;
    out.position = mesh.position;
    out.uv = mesh.uv;
    out.panel_name = mesh.panel_name;
    out.corner_position.reserve(mesh.corner_position.size());
    out.corner_uv.reserve(mesh.corner_uv.size());
    out.face_offset.reserve(mesh.face_offset.size());
    out.face_panel.reserve(mesh.face_panel.size());
    std::vector<std::uint32_t> vertices, sorted;
    std::vector<std::int32_t> uvs;
    // Faces by a hash of their vertices, as lists, to find duplicates.
    std::vector<std::uint32_t> head(std::bit_ceil(2 * mesh.face_count() + 1), kNone), next;
    const auto slot = [&] {
        std::uint64_t hash = 0;
        for (const std::uint32_t v : sorted)
            hash = std::rotl(hash ^ v, 23) * 0x9e3779b97f4a7c15u;
        return static_cast<std::size_t>(hash >> 32) & (head.size() - 1);
    };
    const auto same_vertices = [&](std::uint32_t f) {
        if (out.face_size(f) != sorted.size())
            return false;
        return std::all_of(
            out.corner_position.begin() + out.face_offset[f],
            out.corner_position.begin() + out.face_offset[f + 1],
            [&](std::uint32_t v) { return std::binary_search(sorted.begin(), sorted.end(), v); });
    };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        vertices.clear();
        uvs.clear();
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            if (mesh.corner_position[c] != mesh.corner_position[mesh.next(f, c)]) {
                vertices.push_back(mesh.corner_position[c]);
                uvs.push_back(mesh.corner_uv[c]);
            }
        sorted = vertices;
        std::sort(sorted.begin(), sorted.end());
        const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
        if (vertices.size() < 3 || repeats) {
            ++report.degenerate_faces;
            keep_place(report.first_place, "degenerate_faces", first_point(mesh, f));
            continue;
        }
        std::uint32_t &first = head[slot()];
        std::uint32_t duplicate = first;
        while (duplicate != kNone && !same_vertices(duplicate))
            duplicate = next[duplicate];
        if (duplicate != kNone) {
            ++report.duplicate_faces;
            keep_place(report.first_place, "duplicate_faces", first_point(mesh, f));
            continue;
        }
        next.push_back(first);
        first = static_cast<std::uint32_t>(out.face_count());
        out.add_face(vertices, uvs, mesh.face_panel[f]);
    }
    return out;
}

void flip_face(PolygonMesh &mesh, std::size_t f) {
    const auto first = static_cast<std::ptrdiff_t>(mesh.face_offset[f]);
    const auto last = static_cast<std::ptrdiff_t>(mesh.face_offset[f + 1]);
    std::reverse(mesh.corner_position.begin() + first, mesh.corner_position.begin() + last);
    std::reverse(mesh.corner_uv.begin() + first, mesh.corner_uv.begin() + last);
}

/// Turns faces over so that neighbours agree; of each connected set the larger area keeps its side.
void orient_faces(PolygonMesh &mesh, ManifoldReport &report) {
    const EdgeTable edges(mesh);
    bool any_same = false;
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        any_same |= uses.size() == 2 && uses[0].forward == uses[1].forward;
    });
    if (!any_same)
        return;
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> links(mesh.face_count());
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() != 2)
            return;
        const bool same = uses[0].forward == uses[1].forward;
        links[uses[0].face].emplace_back(uses[1].face, same);
        links[uses[1].face].emplace_back(uses[0].face, same);
    });
    enum class Side : char { unknown, kept, flipped };
    std::vector<Side> side(mesh.face_count(), Side::unknown);
    for (std::uint32_t seed = 0; seed < mesh.face_count(); ++seed) {
        if (side[seed] != Side::unknown)
            continue;
        std::vector<std::uint32_t> part{seed};
        side[seed] = Side::kept;
        double kept_area = 0.0, flipped_area = 0.0;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const std::uint32_t f = part[i];
            double area = 0.0;
            face_normal(mesh, f, area);
            (side[f] == Side::kept ? kept_area : flipped_area) += area;
            for (const auto &[other, same] : links[f])
                if (side[other] == Side::unknown) {
                    side[other] = (side[f] == Side::kept) == same ? Side::flipped : Side::kept;
                    part.push_back(other);
                }
        }
        const Side turned = flipped_area > kept_area ? Side::kept : Side::flipped;
        for (const std::uint32_t f : part)
            if (side[f] == turned) {
                flip_face(mesh, f);
                ++report.flipped_faces;
                keep_place(report.first_place, "flipped_faces", first_point(mesh, f));
            }
    }
}

void drop_isolated_vertices(PolygonMesh &mesh, ManifoldReport &report, PositionRecipe &recipe) {
    std::vector<std::uint32_t> number(mesh.position.size(), kNone);
    for (const std::uint32_t v : mesh.corner_position)
        number[v] = 0;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t v = 0; v < number.size(); ++v)
        if (number[v] == 0) {
            number[v] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(v);
        }
    if (kept.size() == mesh.position.size())
        return;
    report.isolated_vertices += mesh.position.size() - kept.size();
    recipe.keep(mesh.position, std::move(kept));
    for (std::uint32_t &v : mesh.corner_position)
        v = number[v];
}

} // namespace

PolygonMesh make_manifold(const PolygonMesh &mesh, ManifoldReport &report, PositionRecipe &recipe) {
    PolygonMesh out = drop_faces(mesh, report);
    // Vertices that only dropped faces used are not isolated in the file, yet go as well.
    drop_isolated_vertices(out, report, recipe);
    orient_faces(out, report);
    EdgeTable(out).for_each_edge([&](std::span<const EdgeUse> uses) {
        const glm::dvec3 &p = out.position[uses[0].low];
        if (uses.size() > 2) {
            ++report.non_manifold_edges;
            keep_place(report.first_place, "non_manifold_edges", p);
        } else if (uses.size() == 2 && uses[0].forward == uses[1].forward) {
            ++report.unorientable_edges;
            keep_place(report.first_place, "unorientable_edges", p);
        }
    });
    report.non_manifold_vertices += split_fans(out, recipe);
    while (const std::size_t detached = detach_faces(out, recipe)) {
        report.detached_faces += detached;
        split_fans(out, recipe);
    }
    return out;
}

} // namespace tsuya::garment

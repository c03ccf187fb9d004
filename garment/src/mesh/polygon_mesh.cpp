#include "tsuya/garment/polygon_mesh.h"

#include <cmath>
#include <limits>

#include "mesh/islands.h"
#include "mesh/valence.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Collects problems at one place and throws once there are too many.
class MeshProblems {
  public:
    explicit MeshProblems(std::string where) : where_(std::move(where)) {}
    void add(std::string what, std::string accepted) {
        problems_.add({std::move(what), where_, std::move(accepted)});
        if (problems_.full())
            throw_if_any();
    }
    void throw_if_any() const { problems_.throw_if_any(); }

  private:
    std::string where_;
    Problems problems_;
};

void check_lengths(const PolygonMesh &mesh, MeshProblems &problems) {
    const std::size_t corners = mesh.corner_position.size();
    if (mesh.face_offset.empty() || mesh.face_offset.front() != 0 ||
        mesh.face_offset.back() != corners)
        problems.add("face_offset does not run from 0 to the number of corners",
                     "expected faces + 1 entries");
    if (mesh.corner_uv.size() != corners)
        problems.add("corner_uv has " + detail::counted(mesh.corner_uv.size(), "entry", "entries"),
                     "expected one a corner, " + std::to_string(corners));
    if (!mesh.face_offset.empty() && mesh.face_panel.size() != mesh.face_count())
        problems.add("face_panel has " +
                         detail::counted(mesh.face_panel.size(), "entry", "entries"),
                     "expected one a face, " + std::to_string(mesh.face_count()));
    if (!mesh.panel_label.empty() && mesh.panel_label.size() != mesh.panel_name.size())
        problems.add("panel_label has " +
                         detail::counted(mesh.panel_label.size(), "entry", "entries"),
                     "expected one a name, " + std::to_string(mesh.panel_name.size()));
    problems.throw_if_any();
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_offset[f + 1] < mesh.face_offset[f] + 3 || mesh.face_offset[f + 1] > corners)
            problems.add("face " + std::to_string(f) + " has fewer than 3 corners",
                         "expected 3 or more");
    problems.throw_if_any();
}

/// Largest coordinate: squares of areas still fit into a double.
constexpr double kLargest = 1e30;

void check_numbers(const PolygonMesh &mesh, MeshProblems &problems) {
    for (std::size_t i = 0; i < mesh.position.size(); ++i) {
        const glm::dvec3 &p = mesh.position[i];
        if (!(glm::dot(p, p) <= kLargest * kLargest))
            problems.add("vertex " + std::to_string(i) + " is not finite or too far away",
                         "expected numbers below 1e30");
    }
    for (std::size_t i = 0; i < mesh.uv.size(); ++i)
        if (!(glm::dot(mesh.uv[i], mesh.uv[i]) <= kLargest * kLargest))
            problems.add("UV " + std::to_string(i) + " is not finite or too large",
                         "expected numbers below 1e30");
}

} // namespace

void PolygonMesh::add_face(const std::vector<std::uint32_t> &positions,
                           const std::vector<std::int32_t> &uvs, std::uint32_t panel) {
    corner_position.insert(corner_position.end(), positions.begin(), positions.end());
    corner_uv.insert(corner_uv.end(), uvs.begin(), uvs.end());
    face_offset.push_back(static_cast<std::uint32_t>(corner_position.size()));
    face_panel.push_back(panel);
}

void check_indices(const PolygonMesh &mesh, const std::string &where) {
    MeshProblems problems(where);
    check_lengths(mesh, problems);
    check_numbers(mesh, problems);
    const auto face_text = [](std::size_t f) { return "face " + std::to_string(f); };
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
            if (mesh.corner_position[c] >= mesh.position.size())
                problems.add(face_text(f) + " names vertex " +
                                 std::to_string(mesh.corner_position[c]),
                             "expected an index below " + std::to_string(mesh.position.size()));
            if (mesh.corner_uv[c] < -1 ||
                mesh.corner_uv[c] >= static_cast<std::int64_t>(mesh.uv.size()))
                problems.add(face_text(f) + " names UV " + std::to_string(mesh.corner_uv[c]),
                             "expected -1 or an index below " + std::to_string(mesh.uv.size()));
        }
        if (!mesh.panel_name.empty() && mesh.face_panel[f] >= mesh.panel_name.size())
            problems.add(face_text(f) + " names panel " + std::to_string(mesh.face_panel[f]),
                         "expected an index below " + std::to_string(mesh.panel_name.size()));
    }
    problems.throw_if_any();
}

bool has_uv(const PolygonMesh &mesh, std::size_t f) {
    for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
        if (mesh.corner_uv[c] < 0)
            return false;
    return true;
}

SetNumbers find_islands(const PolygonMesh &mesh, const EdgeTable &edges) {
    // Union of faces over edges that have the same UV at both ends on both sides.
    DisjointSets islands(mesh.face_count());
    edges.for_each_edge([&](std::span<const EdgeUse> uses) {
        for (std::size_t i = 1; i < uses.size(); ++i) {
            const EdgeUse &a = uses[0], &b = uses[i];
            const bool continuous = uv_at(mesh, a, a.low) == uv_at(mesh, b, b.low) &&
                                    uv_at(mesh, a, a.high) == uv_at(mesh, b, b.high) &&
                                    has_uv(mesh, a.face) == has_uv(mesh, b.face);
            if (continuous)
                islands.unite(a.face, b.face);
        }
    });
    return islands.number();
}

UvIslands uv_islands(const PolygonMesh &mesh) {
    SetNumbers islands = find_islands(mesh, EdgeTable(mesh));
    return {std::move(islands.of), islands.count};
}

void share_equal_uvs(PolygonMesh &mesh) {
    if (mesh.uv.empty())
        return;
    // Corners by vertex, then each corner takes the first index of its vertex with the same value.
    std::vector<std::uint32_t> start(mesh.position.size() + 1, 0);
    for (const std::uint32_t v : mesh.corner_position)
        ++start[v + 1];
    for (std::size_t v = 1; v < start.size(); ++v)
        start[v] += start[v - 1];
    struct Seen {
        std::int32_t uv;
        std::uint32_t panel;
    };
    std::vector<Seen> seen(mesh.corner_position.size());
    std::vector<std::uint32_t> seen_end(start.begin(), start.end() - 1);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c) {
            const std::int32_t uv = mesh.corner_uv[c];
            if (uv < 0)
                continue;
            const std::uint32_t v = mesh.corner_position[c];
            bool found = false;
            for (std::uint32_t i = start[v]; i < seen_end[v] && !found; ++i) {
                found = seen[i].panel == mesh.face_panel[f] &&
                        mesh.uv[static_cast<std::size_t>(seen[i].uv)] ==
                            mesh.uv[static_cast<std::size_t>(uv)];
                if (found)
                    mesh.corner_uv[c] = seen[i].uv;
            }
            if (!found)
                seen[seen_end[v]++] = {uv, mesh.face_panel[f]};
        }
}

void check_valence(const PolygonMesh &mesh) {
    std::vector<std::uint32_t> valence(mesh.position.size(), 0);
    for (const std::uint32_t v : mesh.corner_position)
        if (++valence[v] >= kMaxValence)
            throw Error({"vertex " + std::to_string(v) + " joins too many faces", "mesh",
                         "expected fewer than " + std::to_string(kMaxValence)});
}

} // namespace tsuya::garment

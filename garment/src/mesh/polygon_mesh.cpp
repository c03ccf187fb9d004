#include "tsuya/garment/polygon_mesh.h"

#include <cmath>
#include <limits>
#include <map>
#include <tuple>

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

SetNumbers find_parts(const PolygonMesh &mesh) {
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    DisjointSets sets(mesh.position.size());
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = mesh.face_offset[f] + 1; c < mesh.face_offset[f + 1]; ++c)
            sets.unite(mesh.corner_position[mesh.face_offset[f]], mesh.corner_position[c]);
    SetNumbers parts{.of = std::vector<std::uint32_t>(mesh.position.size(), kNone)};
    for (std::size_t f = 0; f < mesh.face_count(); ++f) {
        std::uint32_t &number = parts.of[sets.find(mesh.corner_position[mesh.face_offset[f]])];
        if (number == kNone)
            number = parts.count++;
    }
    for (std::uint32_t v = 0; v < parts.of.size(); ++v)
        parts.of[v] = parts.of[sets.find(v)];
    return parts;
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

namespace {

/// UVs of the corners of each vertex that were met so far. Vertices of few corners are searched,
/// the others have a map.
class SharedUvs {
  public:
    explicit SharedUvs(const PolygonMesh &mesh) : mesh_(mesh), start_(mesh.position.size() + 1, 0) {
        for (const std::uint32_t v : mesh.corner_position)
            ++start_[v + 1];
        for (std::size_t v = 1; v < start_.size(); ++v)
            start_[v] += start_[v - 1];
        seen_.resize(mesh.corner_position.size());
        end_.assign(start_.begin(), start_.end() - 1);
    }

    /// The first UV index of this vertex and panel with the same value.
    std::int32_t first(std::uint32_t vertex, std::uint32_t panel, std::int32_t uv) {
        constexpr std::uint32_t kSearched = 64;
        const glm::dvec2 &value = mesh_.uv[static_cast<std::size_t>(uv)];
        if (start_[vertex + 1] - start_[vertex] > kSearched)
            return many_.try_emplace({vertex, panel, value.x, value.y}, uv).first->second;
        for (std::uint32_t i = start_[vertex]; i < end_[vertex]; ++i)
            if (seen_[i].panel == panel && mesh_.uv[static_cast<std::size_t>(seen_[i].uv)] == value)
                return seen_[i].uv;
        seen_[end_[vertex]++] = {uv, panel};
        return uv;
    }

  private:
    struct Seen {
        std::int32_t uv;
        std::uint32_t panel;
    };
    const PolygonMesh &mesh_;
    std::vector<std::uint32_t> start_, end_; ///< of each vertex in `seen_`
    std::vector<Seen> seen_;
    std::map<std::tuple<std::uint32_t, std::uint32_t, double, double>, std::int32_t> many_;
};

} // namespace

void share_equal_uvs(PolygonMesh &mesh) {
    if (mesh.uv.empty())
        return;
    SharedUvs shared(mesh);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        for (std::uint32_t c = mesh.face_offset[f]; c < mesh.face_offset[f + 1]; ++c)
            if (mesh.corner_uv[c] >= 0)
                mesh.corner_uv[c] =
                    shared.first(mesh.corner_position[c], mesh.face_panel[f], mesh.corner_uv[c]);
}

namespace {

void check_corners_of_vertices(const PolygonMesh &mesh, std::uint32_t most) {
    std::vector<std::uint32_t> valence(mesh.position.size(), 0);
    for (const std::uint32_t v : mesh.corner_position)
        if (++valence[v] >= most)
            throw Error({"vertex " + std::to_string(v) + " joins too many faces", "mesh",
                         "expected fewer than " + std::to_string(most)});
}

} // namespace

void check_sizes(const PolygonMesh &mesh) {
    check_corners_of_vertices(mesh, kMaxFileValence);
    for (std::size_t f = 0; f < mesh.face_count(); ++f)
        if (mesh.face_size(f) >= kMaxFaceSize)
            throw Error({"face " + std::to_string(f) + " has " +
                             detail::counted(mesh.face_size(f), "corner"),
                         "mesh", "expected fewer than " + std::to_string(kMaxFaceSize)});
}

void check_valence(const PolygonMesh &mesh) { check_corners_of_vertices(mesh, kMaxValence); }

} // namespace tsuya::garment

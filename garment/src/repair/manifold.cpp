#include <algorithm>
#include <bit>
#include <limits>

#include "mesh/face_plane.h"
#include "mesh/stop.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

void flip_face(PolygonMesh &mesh, std::size_t f) {
    const auto first = static_cast<std::ptrdiff_t>(mesh.face_offset[f]);
    const auto last = static_cast<std::ptrdiff_t>(mesh.face_offset[f + 1]);
    std::reverse(mesh.corner_position.begin() + first, mesh.corner_position.begin() + last);
    std::reverse(mesh.corner_uv.begin() + first, mesh.corner_uv.begin() + last);
}

/// Faces in lists by their smallest vertex, to find duplicates: neighbours are near in memory.
class FaceLists {
  public:
    FaceLists(std::size_t vertices, std::size_t faces) : head_(vertices, kNone) {
        entries_.reserve(faces);
    }

    /// True where `same(g)` holds for a face g that was added with these vertices; else they are
    /// added as the next face. \param sorted vertices, ascending
    template <typename Same>
    bool has_or_add(const std::vector<std::uint32_t> &sorted, Same &&same) {
        std::uint32_t hash = 0;
        for (const std::uint32_t v : sorted)
            hash = std::rotl(hash ^ v, 11) * 0x9e3779b9u;
        std::uint32_t &first = head_[sorted.front()];
        for (std::uint32_t g = first; g != kNone; g = entries_[g].next)
            if (entries_[g].hash == hash && same(g))
                return true;
        entries_.push_back({first, hash});
        first = static_cast<std::uint32_t>(entries_.size() - 1);
        return false;
    }

  private:
    struct Entry {
        std::uint32_t next, hash;
    };
    std::vector<std::uint32_t> head_;
    std::vector<Entry> entries_;
};

} // namespace

void MeshRepair::make_manifold() {
    if (settled_)
        return;
    drop_faces();
    // Vertices that only dropped faces used are not isolated in the file, yet go as well.
    drop_isolated_vertices();
    orient_faces();
    count_non_manifold_edges();
    manifold().non_manifold_vertices += split_fans();
    settled_ = true;
    while (const std::size_t detached = detach_faces()) {
        manifold().detached_faces += detached;
        split_fans();
        settled_ = false; // vertices that the faces left may be isolated
    }
}

/// Drops repeated corners that follow each other, faces that keep fewer than 3 different vertices
/// or name a vertex twice, and faces with the vertices of an earlier one. What is kept moves up.
void MeshRepair::drop_faces() {
    ManifoldReport &found = manifold();
    std::vector<std::uint32_t> vertices, sorted;
    std::vector<std::int32_t> uvs;
    FaceLists known(mesh_.position.size(), mesh_.face_count());
    const auto same_vertices = [&](std::uint32_t f) {
        if (mesh_.face_size(f) != sorted.size())
            return false;
        return std::all_of(
            mesh_.corner_position.begin() + mesh_.face_offset[f],
            mesh_.corner_position.begin() + mesh_.face_offset[f + 1],
            [&](std::uint32_t v) { return std::binary_search(sorted.begin(), sorted.end(), v); });
    };
    std::uint32_t kept = 0, corners = 0, first = 0;
    for (std::size_t f = 0; f < mesh_.face_count(); ++f) {
        look_at_stop(progress_, f);
        const std::uint32_t begin = first, end = mesh_.face_offset[f + 1];
        first = end;
        vertices.clear();
        uvs.clear();
        for (std::uint32_t c = begin; c < end; ++c)
            if (mesh_.corner_position[c] != mesh_.corner_position[c + 1 == end ? begin : c + 1]) {
                vertices.push_back(mesh_.corner_position[c]);
                uvs.push_back(mesh_.corner_uv[c]);
            }
        const glm::dvec3 place = mesh_.position[mesh_.corner_position[begin]];
        sorted = vertices;
        std::sort(sorted.begin(), sorted.end());
        const bool repeats = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
        if (vertices.size() < 3 || repeats) {
            ++found.degenerate_faces;
            keep_place(found.first_place, "degenerate_faces", place);
            continue;
        }
        if (known.has_or_add(sorted, same_vertices)) {
            ++found.duplicate_faces;
            keep_place(found.first_place, "duplicate_faces", place);
            continue;
        }
        std::copy(vertices.begin(), vertices.end(), mesh_.corner_position.begin() + corners);
        std::copy(uvs.begin(), uvs.end(), mesh_.corner_uv.begin() + corners);
        corners += static_cast<std::uint32_t>(vertices.size());
        mesh_.face_panel[kept] = mesh_.face_panel[f];
        mesh_.face_offset[++kept] = corners;
    }
    if (corners == mesh_.corner_position.size())
        return;
    mesh_.corner_position.resize(corners);
    mesh_.corner_uv.resize(corners);
    mesh_.face_panel.resize(kept);
    mesh_.face_offset.resize(kept + 1);
    faces_changed();
}

/// Turns faces over so that neighbours agree; of each connected set the larger area keeps its side.
void MeshRepair::orient_faces() {
    bool any_same = false;
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        any_same |= uses.size() == 2 && uses[0].forward == uses[1].forward;
    });
    if (!any_same)
        return;
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> links(mesh_.face_count());
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() != 2)
            return;
        const bool same = uses[0].forward == uses[1].forward;
        links[uses[0].face].emplace_back(uses[1].face, same);
        links[uses[1].face].emplace_back(uses[0].face, same);
    });
    enum class Side : char { unknown, kept, flipped };
    std::vector<Side> side(mesh_.face_count(), Side::unknown);
    for (std::uint32_t seed = 0; seed < mesh_.face_count(); ++seed) {
        if (side[seed] != Side::unknown)
            continue;
        std::vector<std::uint32_t> part{seed};
        side[seed] = Side::kept;
        double kept_area = 0.0, flipped_area = 0.0;
        for (std::size_t i = 0; i < part.size(); ++i) {
            const std::uint32_t f = part[i];
            const double area = face_plane(mesh_, f).area;
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
                flip_face(mesh_, f);
                ++manifold().flipped_faces;
                keep_place(manifold().first_place, "flipped_faces", first_point(f));
            }
    }
    faces_changed();
}

void MeshRepair::drop_isolated_vertices() {
    std::vector<std::uint32_t> number(mesh_.position.size(), kNone);
    for (const std::uint32_t v : mesh_.corner_position)
        number[v] = 0;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t v = 0; v < number.size(); ++v)
        if (number[v] == 0) {
            number[v] = static_cast<std::uint32_t>(kept.size());
            kept.push_back(v);
        }
    if (kept.size() == mesh_.position.size())
        return;
    manifold().isolated_vertices += mesh_.position.size() - kept.size();
    layers_.keep(kept);
    recipe_.keep(mesh_.position, std::move(kept));
    for (std::uint32_t &v : mesh_.corner_position)
        v = number[v];
    faces_changed();
}

void MeshRepair::count_non_manifold_edges() {
    ManifoldReport &found = manifold();
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        const glm::dvec3 &p = mesh_.position[uses[0].low];
        if (uses.size() > 2) {
            ++found.non_manifold_edges;
            keep_place(found.first_place, "non_manifold_edges", p);
        } else if (uses.size() == 2 && uses[0].forward == uses[1].forward) {
            ++found.unorientable_edges;
            keep_place(found.first_place, "unorientable_edges", p);
        }
    });
}

} // namespace tsuya::garment

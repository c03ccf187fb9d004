// Fans of faces about vertices: how a mesh that is not manifold is taken apart.

#include <algorithm>
#include <limits>
#include <set>

#include "mesh/disjoint_sets.h"
#include "mesh/face_plane.h"
#include "repair/mesh_repair.h"

namespace tsuya::garment {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Sides of one edge beyond which none are paired: cloth has no so many layers in one seam, and the
/// time grows with the third power.
constexpr std::size_t kMostPaired = 64;

/// Joins sides of edges and keeps the fans as sets of corners.
class FanBuilder {
  public:
    FanBuilder(const PolygonMesh &mesh, const EdgeTable &edges)
        : mesh_(mesh), fan_(mesh.corner_position.size()) {
        edges.for_each_edge([&](std::span<const EdgeUse> uses) {
            if (uses.size() == 2 && uses[0].forward != uses[1].forward)
                pair(uses[0], uses[1]);
            else if (uses.size() > 2)
                crowded_.emplace_back(uses.begin(), uses.end());
        });
        pair_crowded();
    }

    std::uint32_t fan_of(std::uint32_t corner) { return fan_.find(corner); }

  private:
    void pair(const EdgeUse &a, const EdgeUse &b) {
        for (const std::uint32_t v : {a.low, a.high})
            fan_.unite(corner_at(mesh_, a, v), corner_at(mesh_, b, v));
    }

    /// Walks along chains of crowded edges, one chain after the other, so that a layer keeps its
    /// partner along a whole seam.
    void pair_crowded() {
        std::vector<std::pair<std::uint32_t, std::uint32_t>> at_vertex; // vertex, crowded edge
        for (std::uint32_t i = 0; i < crowded_.size(); ++i) {
            at_vertex.emplace_back(crowded_[i][0].low, i);
            at_vertex.emplace_back(crowded_[i][0].high, i);
        }
        std::sort(at_vertex.begin(), at_vertex.end());
        std::vector<bool> done(crowded_.size(), false);
        std::vector<std::uint32_t> stack;
        for (std::uint32_t seed = 0; seed < crowded_.size(); ++seed) {
            stack.push_back(seed);
            while (!stack.empty()) {
                const std::uint32_t i = stack.back();
                stack.pop_back();
                if (done[i])
                    continue;
                done[i] = true;
                pair_edge(crowded_[i]);
                for (const std::uint32_t v : {crowded_[i][0].low, crowded_[i][0].high})
                    for (auto it =
                             std::lower_bound(at_vertex.begin(), at_vertex.end(), std::pair(v, 0u));
                         it != at_vertex.end() && it->first == v; ++it)
                        stack.push_back(it->second);
            }
        }
    }

    /// The less, the sooner two sides of one edge are paired.
    double cost(const EdgeUse &a, const EdgeUse &b) {
        const auto same_fan = [&](std::uint32_t v) {
            return fan_of(corner_at(mesh_, a, v)) == fan_of(corner_at(mesh_, b, v));
        };
        const double flatness =
            glm::dot(face_plane(mesh_, a.face).normal, face_plane(mesh_, b.face).normal);
        const double panels = mesh_.face_panel[a.face] == mesh_.face_panel[b.face] ? 4.0 : 0.0;
        return panels - flatness - (same_fan(a.low) || same_fan(a.high) ? 8.0 : 0.0);
    }

    void pair_edge(std::vector<EdgeUse> uses) {
        if (uses.size() > kMostPaired)
            return;
        while (uses.size() > 1) {
            std::size_t best_i = 0, best_j = 0;
            double best = std::numeric_limits<double>::max();
            for (std::size_t i = 0; i < uses.size(); ++i)
                for (std::size_t j = i + 1; j < uses.size(); ++j)
                    if (const double c =
                            uses[i].forward != uses[j].forward ? cost(uses[i], uses[j]) : best;
                        c < best) {
                        best = c;
                        best_i = i;
                        best_j = j;
                    }
            if (best_j == 0)
                return; // only sides of one direction are left
            pair(uses[best_i], uses[best_j]);
            uses.erase(uses.begin() + static_cast<std::ptrdiff_t>(best_j));
            uses.erase(uses.begin() + static_cast<std::ptrdiff_t>(best_i));
        }
    }

    const PolygonMesh &mesh_;
    DisjointSets fan_;
    std::vector<std::vector<EdgeUse>> crowded_; ///< edges of more than two sides
};

} // namespace

std::size_t MeshRepair::split_fans() {
    FanBuilder fans(mesh_, edges());
    // The fan of a vertex' first corner keeps the vertex.
    std::vector<std::uint32_t> vertex_of_fan(mesh_.corner_position.size(), kNone);
    std::vector<bool> taken(mesh_.position.size(), false);
    const std::size_t before = mesh_.position.size();
    for (std::uint32_t c = 0; c < vertex_of_fan.size(); ++c) {
        std::uint32_t &v = vertex_of_fan[fans.fan_of(c)];
        const std::uint32_t old = mesh_.corner_position[c];
        if (v == kNone && !taken[old]) {
            v = old;
            taken[old] = true;
        } else if (v == kNone) {
            v = copy_vertex(old);
        }
        mesh_.corner_position[c] = v;
    }
    if (mesh_.position.size() > before)
        faces_changed();
    return mesh_.position.size() - before;
}

std::size_t MeshRepair::detach_faces() {
    std::set<std::uint32_t> faces;
    edges().for_each_edge([&](std::span<const EdgeUse> uses) {
        if (uses.size() > 2 || (uses.size() == 2 && uses[0].forward == uses[1].forward))
            for (std::size_t i = 1; i < uses.size(); ++i)
                faces.insert(uses[i].face);
    });
    if (faces.empty())
        return 0;
    for (const std::uint32_t f : faces)
        for (std::uint32_t c = mesh_.face_offset[f]; c < mesh_.face_offset[f + 1]; ++c)
            mesh_.corner_position[c] = copy_vertex(mesh_.corner_position[c]);
    faces_changed();
    return faces.size();
}

} // namespace tsuya::garment

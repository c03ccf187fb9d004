#pragma once
/// \file
/// Edges of a polygon mesh that need not be manifold.

#include <cstdint>
#include <span>
#include <vector>

#include "tsuya/garment/polygon_mesh.h"

namespace tsuya::garment {

/// One face's side of an edge. `corner` is where the side starts.
struct EdgeUse {
    std::uint32_t low = 0, high = 0; ///< vertices, low < high
    std::uint32_t face = 0;
    std::uint32_t corner = 0;
    bool forward = true; ///< the face runs from low to high
};

/// All sides of all edges, those of one edge beside each other, in the order of their faces.
class EdgeTable {
  public:
    explicit EdgeTable(const PolygonMesh &mesh);

    /// Calls `visit(std::span<const EdgeUse>)` for each edge.
    template <typename Visit> void for_each_edge(Visit &&visit) const {
        for (std::size_t begin = 0; begin < uses_.size();) {
            std::size_t end = begin + 1;
            while (end < uses_.size() && uses_[end].low == uses_[begin].low &&
                   uses_[end].high == uses_[begin].high)
                ++end;
            visit(std::span<const EdgeUse>(uses_.data() + begin, end - begin));
            begin = end;
        }
    }

  private:
    std::vector<EdgeUse> uses_;
};

/// The corner of the side's face at `vertex`, one of the two ends.
inline std::uint32_t corner_at(const PolygonMesh &mesh, const EdgeUse &use, std::uint32_t vertex) {
    return mesh.corner_position[use.corner] == vertex ? use.corner
                                                      : mesh.next(use.face, use.corner);
}

/// The UV index of the side's face at `vertex`, one of the two ends.
inline std::int32_t uv_at(const PolygonMesh &mesh, const EdgeUse &use, std::uint32_t vertex) {
    return mesh.corner_uv[corner_at(mesh, use, vertex)];
}

} // namespace tsuya::garment

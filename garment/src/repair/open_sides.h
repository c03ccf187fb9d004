#pragma once
/// \file
/// The boundary: sides of edges that only one face has.

#include <span>
#include <vector>

#include "mesh/edges.h"
#include "mesh/place_grid.h"
#include "repair/rims.h"

namespace tsuya::garment {

/// A half-edge without a partner, as its face runs.
struct OpenSide {
    std::uint32_t from = 0, to = 0; ///< vertices
    std::uint32_t face = 0;
    std::uint32_t corner = 0; ///< where the side starts

    bool touches(std::uint32_t v) const { return from == v || to == v; }
};

/// All open sides by place, in ascending order of the vertices where they start. In a manifold mesh
/// one side starts at each vertex of the boundary.
class OpenSides {
  public:
    /// \param mesh must outlive this
    /// \param reach metres; how far from a side it is found
    OpenSides(const PolygonMesh &mesh, const EdgeTable &edges, double reach);

    const std::vector<OpenSide> &sides() const { return sides_; }
    /// The ends of all sides, ascending.
    const std::vector<std::uint32_t> &vertices() const { return vertices_; }
    /// Numbers of sides, ascending, some more than once: all that pass within `reach` of the point.
    std::span<const std::uint32_t> near(const glm::dvec3 &p) const { return grid_.at(p); }

    const glm::dvec3 &start(const OpenSide &side) const { return mesh_.position[side.from]; }
    const glm::dvec3 &end(const OpenSide &side) const { return mesh_.position[side.to]; }
    /// The side's face has the vertex.
    bool face_has(const OpenSide &side, std::uint32_t v) const;

    /// How the rim at a vertex of the boundary lies to a side that passes it.
    Contact contact(std::uint32_t vertex, const OpenSide &side, double tolerance) const;

  private:
    static std::vector<OpenSide> collect(const EdgeTable &edges);
    PlaceGrid make_grid(double reach) const;

    const PolygonMesh &mesh_;
    std::vector<OpenSide> sides_;
    std::vector<std::uint32_t> by_end_; ///< sides in ascending order of their ends
    std::vector<std::uint32_t> vertices_;
    PlaceGrid grid_;
};

} // namespace tsuya::garment

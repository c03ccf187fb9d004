#pragma once
/// \file
/// How the points of all tessellated faces are numbered so that neighbours share them.

#include <map>
#include <vector>

#include "limit/tessellation_rates.h"

namespace tsuya::garment {

/// The points and triangles of a face of one size, in the face's own coordinates. The boundary
/// comes first: corner 0, the points of edge 0, corner 1, ...
struct FacePattern {
    std::vector<glm::dvec2> coordinate{};
    std::vector<glm::uvec3> triangle{};
    std::uint32_t interior_count = 0;
};

/// The pattern of every face; faces that are cut alike share one.
class FacePatterns {
  public:
    FacePatterns(const LimitSurface &surface, const TessellationRates &rates,
                 const Progress &progress);
    const FacePattern &of(std::size_t face) const { return patterns_[of_face_[face]]; }

  private:
    std::vector<FacePattern> patterns_;
    std::vector<std::uint32_t> of_face_;
};

/// Numbers the vertices of the limit surface face by face: those numbered with face f are
/// `face_first()[f]` up to `face_first()[f + 1]` and are that face's to evaluate. A corner or edge
/// is shared by faces of one panel whose UV indices agree there.
class LimitNumbering {
  public:
    LimitNumbering(const LimitSurface &surface, const FacePatterns &patterns,
                   const TessellationRates &rates, const Progress &progress);

    /// Vertex of each coordinate of the face's pattern, in the pattern's order.
    void face_vertices(std::size_t face, std::uint32_t interior_count,
                       std::vector<std::uint32_t> &vertices) const;

    /// Vertex of a corner of the control mesh.
    std::uint32_t corner_vertex(std::uint32_t corner) const { return corner_vertex_[corner]; }
    const std::vector<std::uint32_t> &face_first() const { return face_first_; }
    /// Per vertex: the first vertex at the same point of the surface.
    const std::vector<std::uint32_t> &place() const { return place_; }

  private:
    /// One way in which a corner or an edge of the mesh appears in the surface; a list by `next`.
    struct Side {
        std::uint32_t
            vertex; ///< of the corner, or of the edge's first inner point from its low end
        std::int32_t uv_low, uv_high;
        std::uint32_t panel;
        std::uint32_t next;
    };

    std::uint32_t find_or_add(std::uint32_t &head, Side side, std::uint32_t count);

    const PolygonMesh &mesh_;
    std::vector<std::uint32_t> face_first_{0};
    std::vector<std::uint32_t> place_;
    std::vector<Side> sides_;
    std::vector<std::uint32_t> corner_vertex_; ///< per corner
    // Empty where no edge is cut.
    std::vector<std::uint32_t> edge_inner_;      ///< per corner: points inside the edge
    std::vector<std::uint32_t> edge_vertex_;     ///< per corner: of the edge that starts there
    std::vector<std::uint32_t> interior_vertex_; ///< per face
};

} // namespace tsuya::garment

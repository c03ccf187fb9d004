#pragma once
/// \file
/// Exact tangents at extraordinary vertices, where Bfr's patches only approach them.

#include <vector>

#include "limit/limit_masks.h"
#include "limit/limit_numbering.h"

namespace tsuya::garment {

/// Tangents at the vertices of the control mesh where faces do not meet as on a regular grid: those
/// inside of Catmull-Clark surfaces, and those of hems of both schemes. Vertices of creases are
/// left to Bfr.
class LimitCorners {
  public:
    LimitCorners(const LimitSurface &surface, const LimitNumbering &numbering,
                 const Progress &progress);

    /// Sets the normals there and, inside of a panel, dp_du and dp_dv. Where the tangents are
    /// parallel nothing is changed. \param positions in the topology that was given
    void apply(const std::vector<glm::dvec3> &positions, const glm::dvec3 &centre,
               LimitMesh &out) const;

  private:
    struct Vertex {
        std::vector<MaskWeight> weight{};    ///< tangents alone
        std::vector<std::uint32_t> points{}; ///< of the tessellation, one for each panel and UV
        glm::dvec2 t_u{0.0}, t_v{0.0};       ///< tangents of the UV; 0 where it is cut
    };

    void add_vertex(const LimitSurface &surface, const LimitNumbering &numbering, int vertex);
    void on_quad_hem(const Ring &ring, std::vector<MaskWeight> &weight) const;
    void on_triangle_hem(const Ring &ring, std::vector<MaskWeight> &weight) const;

    const PolygonMesh &mesh_;
    std::vector<Vertex> vertices_;
};

} // namespace tsuya::garment

#pragma once
/// \file
/// The limit surface at a vertex of the control mesh, straight from the faces about it.

#include <optional>
#include <vector>

#include "limit/limit_surface.h"

namespace tsuya::garment {

/// The faces about a vertex, counter-clockwise; those of a hem start at its first edge.
struct Ring {
    std::vector<std::size_t> face{};
    std::vector<std::uint32_t> corner{}; ///< where each face has the vertex

    Ring() = default;
    Ring(const LimitSurface &surface, int vertex) { set(surface, vertex); }
    void set(const LimitSurface &surface, int vertex);
    std::size_t size() const { return face.size(); }
    /// The corner at the far end of the edge that starts face `i`, or that ends the last.
    std::uint32_t spoke(const PolygonMesh &mesh, std::size_t i) const {
        return i < size() ? mesh.next(face[i], corner[i])
                          : mesh.previous(face.back(), corner.back());
    }
    /// The UVs of all faces go on across all edges at the vertex, which lies inside.
    bool has_whole_uv(const PolygonMesh &mesh) const;
};

/// A corner of the control mesh and its weight in the limit position and in two tangents, which
/// turn with the faces.
struct MaskWeight {
    std::uint32_t corner;
    double position;
    glm::dvec2 tangents;
};

/// Appends the weights of a vertex of `ring`, which lies inside and has 3 faces or more.
void mask_inside(const LimitSurface &surface, const Ring &ring, std::vector<MaskWeight> &weights);

/// Subdominant eigenvalue of Catmull-Clark for an angle of `theta` between edges. [CatmullClark]
double catmark_eigenvalue(double theta);

/// True for edges inside of the mesh at the vertex that are sharp.
bool has_crease(const OpenSubdiv::Far::TopologyLevel &level, int vertex);

/// Evaluates the vertices that masks know. One for a thread.
class LimitMasks {
  public:
    /// Empty where the surface has no mask: on hems, at creases and where UVs part. The position is
    /// relative to the surface's centre.
    std::optional<LimitSample> sample(const LimitSurface &surface, int vertex);

  private:
    Ring ring_{};
    std::vector<MaskWeight> weights_{};
};

} // namespace tsuya::garment

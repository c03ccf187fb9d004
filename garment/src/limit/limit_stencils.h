#pragma once
/// \file
/// The limit surface as weighted sums of control points: fast for many frames of one topology.

#include <set>
#include <vector>

#include "limit/limit_numbering.h"

namespace tsuya::garment {

/// Weights of position and derivatives for every vertex of a tessellation.
class LimitStencils {
  public:
    LimitStencils(const LimitSurface &surface, const FacePatterns &patterns,
                  const LimitNumbering &numbering, const Progress &progress);

    /// Sets position, normal, dp_du and dp_dv of the vertices of `out`, whose arrays have their
    /// lengths. Where tangents vanish, the normal is that of the control face.
    /// \param mesh the positions, in the topology that was given
    void apply(const PolygonMesh &mesh, const glm::dvec3 &centre, LimitMesh &out) const;

  private:
    /// For each control point of a face, its weights in the positions of the face's vertices, then
    /// in both derivatives of each; then for each control point of the cloth alone its weights in
    /// both derivatives. Faces that are regular and cut alike share one, which keeps it
    /// in the cache.
    using Weights = std::vector<double>;
    struct Face {
        std::vector<std::uint32_t> control;
        std::vector<std::uint32_t> cloth{}; ///< empty where no UVs part
        const Weights *weight = nullptr;
    };
    /// \param sums scratch
    void apply_face(std::size_t face, const PolygonMesh &mesh, const glm::dvec3 &centre,
                    std::vector<double> &sums, LimitMesh &out) const;

    std::set<Weights> weights_; ///< its elements do not move
    std::vector<Face> face_;
    std::vector<std::uint32_t> first_; ///< first vertex of each face
    struct Cloth {
        glm::dvec4 rows{0.0}; ///< u and v by the face's coordinates, inverted
        bool alone = false;   ///< of the derivatives of the panel alone
    };
    std::vector<Cloth> cloth_; ///< per vertex
};

} // namespace tsuya::garment

#pragma once
/// \file
/// The limit surface of a control mesh as something that can be evaluated at any point of any face.

#include <cmath>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/far/topologyRefiner.h>

#include "tsuya/garment/subdivide.h"

namespace tsuya::garment {

inline constexpr double kInfinitelySharp = 10.0; ///< Sdc::Crease::SHARPNESS_INFINITE

/// Position, UV and their derivatives by the face's own coordinates.
struct LimitSample {
    glm::dvec3 p, p_u, p_v;
    glm::dvec2 t{0.0}, t_u{0.0}, t_v{0.0};
    /// Derivatives of the position that go with those of the UV, see LimitSurface::sample.
    glm::dvec3 cloth_u{0.0}, cloth_v{0.0};
    bool alone = false; ///< they are of the panel alone

    /// False where the tangents enclose no area.
    bool normal(glm::dvec3 &n) const;
    /// Derivatives by UV; false where the UV is degenerate.
    bool cloth(glm::dvec3 &dp_du, glm::dvec3 &dp_dv) const;
};

inline bool LimitSample::normal(glm::dvec3 &n) const {
    // Squared sine of the angle between the tangents below which they count as parallel.
    constexpr double kParallel = 1e-16;
    n = glm::cross(p_u, p_v);
    const double length2 = glm::dot(n, n);
    if (!(length2 > kParallel * glm::dot(p_u, p_u) * glm::dot(p_v, p_v)) || !(length2 > 0.0))
        return false;
    n /= std::sqrt(length2);
    return true;
}

/// Second derivatives of the position by the face's own coordinates.
struct LimitCurvature {
    glm::dvec3 normal{0.0}; ///< of the surface; 0 where it has none
    glm::dvec3 p_u{0.0}, p_v{0.0};
    glm::dvec3 p_uu{0.0}, p_uv{0.0}, p_vv{0.0};
};

/// Evaluates by OpenSubdiv's Bfr. Several threads may evaluate, each with a Scratch of its own.
class LimitSurface {
  public:
    using Surface = OpenSubdiv::Bfr::Surface<double>;
    struct Scratch {
        Surface surface, uv_surface;
        std::vector<double> points, uv_points;
        std::vector<double> cloth_points; ///< of `uv_surface`; empty where both follow one rule
        double one_sided = 0.0; ///< what derivatives of the panel alone may err by, relative
        std::vector<int> control, cloth_control; ///< vertices of both
        bool has_uv = false;
    };

    /// \param mesh manifold; must outlive this
    /// Throws Error for the Loop scheme with faces that are not triangles, and for bad options.
    LimitSurface(const PolygonMesh &mesh, const SubdivideOptions &options,
                 const Progress &progress);

    OpenSubdiv::Sdc::SchemeType scheme() const { return scheme_; }
    const OpenSubdiv::Far::TopologyLevel &topology() const { return refiner_->GetLevel(0); }
    const PolygonMesh &mesh() const { return mesh_; }
    /// Other positions for the same topology.
    void set_positions(const std::vector<glm::dvec3> &positions);
    const glm::dvec3 &centre() const { return centre_; }
    /// A control point relative to `centre`.
    const glm::dvec3 &relative(std::uint32_t vertex) const { return relative_[vertex]; }

    /// Sets `scratch` to a face; the following work on that face.
    void prepare(std::size_t face, Scratch &scratch) const;
    /// The same without UVs, which samples lack then.
    void prepare_positions(std::size_t face, Scratch &scratch) const;
    /// \param at the face's own coordinates. The position is relative to `centre`.
    /// At a seam the position follows the rules of the inside and the UV those of a hem: among
    /// faces of all shapes their derivatives do not go together, and those of the panel alone, with
    /// its seams as hems, are taken. These are one-sided, of the first order alone, so where both
    /// agree as well as the bend of the face lets them, the surface's own are.
    LimitSample sample(const glm::dvec2 &at, const Scratch &scratch) const;
    /// The position alone, relative to `centre`.
    glm::dvec3 point(const glm::dvec2 &at, const Scratch &scratch) const;
    LimitCurvature curvature(const glm::dvec2 &at, const Scratch &scratch) const;
    /// A point near `at`, a little nearer to the middle of the face.
    glm::dvec2 nudged(const glm::dvec2 &at, const Scratch &scratch) const;

  private:
    void init(std::size_t face, Scratch &scratch, bool with_uv) const;
    void prepare_cloth(Scratch &scratch) const;
    /// Sets the derivatives of the panel alone; false where the UV is degenerate.
    static bool take_alone(const glm::dvec2 &at, const Scratch &scratch, LimitSample &sample,
                           glm::dmat2x3 &dp);

    using Factory =
        OpenSubdiv::Bfr::RefinerSurfaceFactory<OpenSubdiv::Bfr::SurfaceFactoryCacheThreaded<
            std::shared_mutex, std::shared_lock<std::shared_mutex>,
            std::unique_lock<std::shared_mutex>>>;

    const PolygonMesh &mesh_;
    OpenSubdiv::Sdc::SchemeType scheme_;
    std::unique_ptr<OpenSubdiv::Far::TopologyRefiner> refiner_;
    std::unique_ptr<Factory> factory_;
    glm::dvec3 centre_{0.0};
    std::vector<glm::dvec3> relative_; ///< positions less the centre
    std::vector<glm::dvec2> uv_;
    std::vector<std::uint32_t> uv_vertex_; ///< the one vertex that has the UV
    std::vector<bool> near_cut_;           ///< vertices of faces where UVs may part
};

} // namespace tsuya::garment

#pragma once
/// \file
/// The limit surface of a control mesh, with the derivatives of the cloth.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/camera.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Subdivision scheme; `automatic` is Loop for meshes of triangles alone, else Catmull-Clark.
// [CatmullClark], [LoopScheme]
enum class Scheme { automatic, catmark, loop };

/// A light as a sphere that holds it, metres.
struct ViewLight {
    glm::dvec3 centre{0.0};
    double radius = 0.0; ///< >= 0
};

/// A camera and lights that say how fine each face must be. Faces outside the picture whose shadows
/// cannot fall into it stay as coarse as the control mesh; the others are as fine as their shadow
/// needs.
struct ViewTolerance {
    Camera camera{};
    double pixels = 0.25; ///< largest departure from the limit surface, in pixels
    std::vector<ViewLight> lights{};
    /// Sharp shadows from any side, such as of a pictured environment: faces outside the picture
    /// are as fine as if they were seen.
    bool light_from_everywhere = false;
    double nearest = 1e-3; ///< metres, > 0: nothing in the picture is nearer to the camera
    /// Metres, > 0: nothing that an orthographic camera sees is farther from its eye. A shadow that
    /// is thrown far shows the departures of its face enlarged.
    double farthest = 100;
};

/// How the limit surface is sampled. Hems stay smooth curves that interpolate sharp corners (a
/// vertex of one face).
struct SubdivideOptions {
    Scheme scheme = Scheme::automatic;
    int level = 1; ///< 0 to 8: each edge of the control mesh is cut into 2^level
    /// Metres. Where this or `view` is set, `level` does not count: each edge is cut into as many
    /// pieces, 1 to 256, as keep triangles this near to the limit surface. Estimated from second
    /// derivatives, then measured at four points of every triangle and raised. Only about vertices
    /// of 12 faces or more were 256 pieces not enough: up to 2.2 times the tolerance was measured.
    std::optional<double> tolerance{};
    std::optional<ViewTolerance> view{}; ///< with `tolerance`, the finer of the two
    double seam_crease = 0.0; ///< sharpness of edges where UVs part, 0 (smooth) to 10 (sharp)
    /// Sharpness of pressed folds, 0 (smooth) to 9: edges inside of the mesh whose faces enclose
    /// more than `fold_angle`. Each step halves the width that is rounded, beginning with the
    /// faces'.
    double fold_crease = 0.0;
    double fold_angle = 1.0; ///< radians between the faces' normals, 0 to pi
};

/// Points of the limit surface. Arrays are as long as `position`; UV arrays may be empty.
struct LimitMesh {
    std::vector<glm::dvec3> position{}; ///< metres; exactly equal where vertices share a `place`
    std::vector<glm::vec3> normal{};    ///< unit
    std::vector<glm::vec2> uv{};        ///< of the control mesh; empty if it has none
    std::vector<glm::vec3> dp_du{};     ///< metres per unit of u; 0 where the UV is degenerate
    std::vector<glm::vec3> dp_dv{};     ///< metres per unit of v; 0 where the UV is degenerate
    std::vector<std::uint32_t> panel{}; ///< per vertex
    std::vector<std::uint32_t> place{}; ///< first vertex at the same point of the surface
    std::vector<glm::uvec3> triangle{};
    std::vector<std::uint32_t> triangle_panel{};
    std::vector<std::string> panel_name{};
    std::size_t repaired_normals = 0; ///< see Report::repaired_normals
};

/// Evaluates the limit surface by OpenSubdiv's Bfr on all threads of TBB. The order of the points
/// does not depend on the number of threads. Level 0 gives the limit points of the control
/// vertices, and the centre of faces that are neither triangle nor quad.
/// UVs are face-varying, with the rules of positions along hems: smooth but for corners and where
/// boundaries meet. \param mesh manifold (see make_manifold) Throws Error for a level out of range,
/// the Loop scheme with faces that are not triangles, a vertex or face of 256 neighbours or more,
/// or more points than the memory holds, before it is taken; Interrupted where `progress` says
/// stop.
LimitMesh subdivide(PolygonMesh mesh, const SubdivideOptions &options = {},
                    const Progress &progress = {});

/// One control mesh whose positions change (an animated show): topology, rates of tessellation,
/// numbering and UVs are worked out once.
class Subdivider {
  public:
    /// Throws as subdivide.
    Subdivider(PolygonMesh mesh, const SubdivideOptions &options, const Progress &progress = {});
    ~Subdivider();
    /// Moves; the subdivider moved from may only be assigned to.
    Subdivider(Subdivider &&) noexcept;
    /// As the move constructor.
    Subdivider &operator=(Subdivider &&) noexcept;

    /// The limit surface of the mesh as it was given.
    LimitMesh evaluate(const Progress &progress = {});
    /// The limit surface of other positions; vertices and triangles keep their numbers. The rates
    /// stay those of the mesh that was given. Throws Error for another number of positions.
    LimitMesh evaluate(const std::vector<glm::dvec3> &positions);
    /// The same in the memory of a mesh that an earlier call gave, or of an empty one.
    void evaluate(const std::vector<glm::dvec3> &positions, LimitMesh &out);
    /// Works out now what the first call with other positions would: weights of the control points.
    void expect_frames(const Progress &progress = {});

  private:
    friend LimitMesh subdivide(PolygonMesh mesh, const SubdivideOptions &options,
                               const Progress &progress);
    struct State;
    std::unique_ptr<State> state_;
};

/// Departure of triangles from the true limit surface, measured at points inside of them.
struct TessellationError {
    double position = 0, position_rms = 0; ///< metres, from the limit point to its triangle
    double pixels = 0;                     ///< the largest in pixels of the camera; 0 without one
    double normal = 0, normal_rms = 0;     ///< radians, of the interpolated normal
    double warp = 0, warp_rms = 0;         ///< radians, of the interpolated dP/dv
    std::size_t triangles = 0;
};

/// Measures what the triangles of `subdivide` depart by. Throws as subdivide.
/// \param camera whose pixels are counted
TessellationError measure_tessellation(const PolygonMesh &mesh, const SubdivideOptions &options,
                                       const std::optional<Camera> &camera = {});

} // namespace tsuya::garment

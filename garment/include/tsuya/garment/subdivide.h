#pragma once
/// \file
/// The limit surface of a control mesh, with the derivatives of the cloth.

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/garment/polygon_mesh.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Subdivision scheme; `automatic` is Loop for meshes of triangles alone, else Catmull-Clark.
// [CatmullClark], [LoopScheme]
enum class Scheme { automatic, catmark, loop };

/// How the limit surface is sampled. Hems stay smooth curves that interpolate sharp corners (a
/// vertex of one face).
struct SubdivideOptions {
    Scheme scheme = Scheme::automatic;
    int level = 1;            ///< 0 to 8: each edge of the control mesh is cut into 2^level
    double seam_crease = 0.0; ///< sharpness of edges where UVs part, 0 (smooth) to 10 (sharp)
};

/// Points of the limit surface. Arrays are as long as `position`; UV arrays may be empty.
struct LimitMesh {
    std::vector<glm::dvec3> position{}; ///< metres; exactly equal where vertices share a `place`
    std::vector<glm::vec3> normal{};    ///< unit
    std::vector<glm::vec2> uv{};        ///< of the control mesh; empty if it has none
    std::vector<glm::vec3> dp_du{};     ///< metres per unit of u; 0 where the UV is degenerate
    std::vector<glm::vec3> dp_dv{};     ///< metres per unit of v; 0 where the UV is degenerate
    std::vector<std::uint16_t> panel{}; ///< per vertex
    std::vector<std::uint32_t> place{}; ///< first vertex at the same point of the surface
    std::vector<glm::uvec3> triangle{};
    std::vector<std::uint16_t> triangle_panel{};
    std::vector<std::string> panel_name{};
    std::size_t repaired_normals = 0; ///< see Report::repaired_normals
};

/// Evaluates the limit surface by OpenSubdiv's Bfr on all threads of TBB. The order of the points
/// does not depend on the number of threads. Level 0 gives the limit points of the control
/// vertices, and the centre of faces that are neither triangle nor quad.
/// UVs are face-varying: smooth inside a panel, linear along its boundary.
/// \param mesh manifold (see make_manifold)
/// Throws Error for a level out of range, the Loop scheme with faces that are not triangles, or a
/// vertex or face of 256 neighbours or more.
LimitMesh subdivide(const PolygonMesh &mesh, const SubdivideOptions &options = {},
                    const Progress &progress = {});

} // namespace tsuya::garment

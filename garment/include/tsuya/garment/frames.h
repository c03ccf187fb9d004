#pragma once
/// \file
/// Warp and weft directions at every point of a garment.

#include <map>
#include <optional>
#include <set>
#include <string>

#include "tsuya/garment/subdivide.h"
#include "tsuya/sdk/surface.h"

namespace tsuya::garment {

/// How yarn directions follow from UVs.
struct FrameOptions {
    /// Panel name to grain angle in radians, counter-clockwise in the UV plane (u right, v up): 0
    /// lays the warp along +v and the weft along +u, pi/2 the warp along -u and the weft along +v.
    std::map<std::string, double> grain{};
    double default_grain = 0; ///< radians; for panels that `grain` does not name
    /// Where a mesh has no UV: nullopt makes a body without yarn directions; a number lays the warp
    /// along the upward vertical (+y) in the tangent plane, turned by this many radians
    /// counter-clockwise about the normal (0: vertical, pi/2: horizontal). Where a mesh has UVs,
    /// the same for the vertices whose UV is degenerate, in place of what spreads from their
    /// neighbours.
    std::optional<double> invented_grain{};
    /// Names of panels whose fabric has no yarn directions: nothing is asked of their UVs.
    std::set<std::string> plain{};
    double metres_per_uv = 1.0;        ///< metres of cloth per unit of UV
    double max_degenerate_area = 0.05; ///< share of the area, 0 to 1, above which it is an error
};

/// What add_frames had to repair.
struct FrameReport {
    std::size_t repaired = 0;       ///< vertices with degenerate UV
    double repaired_area_share = 0; ///< share of the area of triangles with such a vertex
    std::size_t mirrored = 0;       ///< vertices of mirrored UV
};

/// Turns limit points into a Surface. warp = dP/dv of the cloth, made perpendicular to the normal
/// and unit; weft = dP/du in the tangent plane, unit, so that the shear of the drape remains. Where
/// the grain is turned, the UV of the surface turns with it: u runs along the weft, v along the
/// warp. Mirrored UVs keep their warp; the weft is then -dP/du, so that weft x warp is always on
/// the side of the normal, and the surface has -u, so that a picture on the cloth reads right.
/// Where the UV is degenerate, directions spread from the nearest valid vertices of the same panel.
/// Throws Error naming `where` if the degenerate share is above its limit or `grain` names an
/// unknown panel; Interrupted.
Surface add_frames(LimitMesh mesh, const FrameOptions &options, FrameReport &report,
                   const std::string &where, const Progress &progress = {});

} // namespace tsuya::garment

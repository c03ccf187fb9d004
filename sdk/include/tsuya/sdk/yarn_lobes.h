#pragma once
/// \file
/// From measured views to the filaments of the two yarn systems: which share of them lies at which
/// slope along its yarn.

#include <array>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"

namespace tsuya {

/// Number of slopes that are told apart: every 2 degrees from -48 to 48.
inline constexpr int kYarnSlopes = 49;
/// Slope of the k-th, radians.
double yarn_slope(int k);

/// The filaments of a cloth.
struct YarnLobes {
    double f0 = 0.05;        ///< reflectance of the fibre at normal incidence, (0, 1]
    double roughness = 0.05; ///< standard deviation of a filament's surface slope, radians
    /// Surface of filaments over that of the cloth at each slope, of yarns along the weft (0) and
    /// the warp (1). pi/2 is a full cover of level filaments.
    std::array<std::array<double, kYarnSlopes>, 2> surface{};
    /// Depth at which the yarns lie between crossing ones, in widths of the opening.
    std::array<double, 2> pit{};
    double even = 0; ///< albedo of what is reflected evenly: light that was inside filaments
};

/// Density of the filaments' normals at a unit direction, for the lobe of one slope with a surface
/// of 1: a cylinder's normals spread evenly about its axis, blurred by the roughness.
double yarn_lobe(int axis, double slope, double roughness, const glm::dvec3 &half);

/// Fits slopes, roughness and the even part to the views with light from straight above. The depth
/// of pits is not seen from above: it follows from how little of the face a system has. Throws
/// Error unless f0 is in (0, 1].
YarnLobes fit_yarn_lobes(const Bard &bard, double f0);

} // namespace tsuya

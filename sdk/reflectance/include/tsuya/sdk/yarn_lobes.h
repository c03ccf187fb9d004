#pragma once
/// \file
/// From measured views to the filaments of the two yarn systems: which share of them lies at which
/// slope along its yarn.

#include <array>
#include <string>

#include <glm/glm.hpp>

#include "tsuya/sdk/bard.h"
#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// Number of slopes that are kept apart: every 2 degrees from -48 to 48.
inline constexpr int kYarnSlopes = 49;
/// Slope of the k-th, radians.
double yarn_slope(int k);

/// Reflectance of a fibre at normal incidence: that of an index of 1.58, fibres have 1.53 to 1.6.
inline constexpr double kFibreF0 = 0.05;

/// The filaments of a cloth.
struct YarnLobes {
    double f0 = kFibreF0; ///< reflectance of the fibre at normal incidence, (0, 1]
    /// Standard deviation of a filament's surface slope, radians, 0.005 to 1
    double roughness = 0.05;
    /// Surface of filaments over that of the cloth at each slope, of yarns along the weft (0) and
    /// the warp (1). pi/2 is a full cover of level filaments.
    std::array<std::array<double, kYarnSlopes>, 2> surface{};
    /// Depth at which the yarns lie between crossing ones, in widths of the opening.
    std::array<double, 2> pit{};
    double even = 0; ///< albedo of the diffuse part: light that was inside filaments
    /// Surface of filaments that lie at all slopes alike: the steep ends of floats.
    double loose = 0;
    /// Depth below its neighbours to which a yarn dives at its steepest slope, in widths of a yarn
    double dive = 0;

    /// Depth below its neighbours of a yarn at each slope, in widths of a yarn: `dive` times the
    /// share of its climb that lies between level and that slope.
    std::array<double, kYarnSlopes> depth(std::size_t axis) const;
    /// Surface of all filaments of the weft (0) or the warp (1) over that of the cloth.
    double filaments(std::size_t axis) const;
    /// Share of the weft in the filaments of both systems; 0.5 where there are none.
    double weft_share() const;
    bool operator==(const YarnLobes &) const = default;
};

/// Density of the filaments' normals at a unit direction, for the lobe of one slope with a surface
/// of 1: a cylinder's normals spread uniformly about its axis, blurred by the roughness.
double yarn_lobe(int axis, double slope, double roughness, const glm::dvec3 &half);
/// The same at the sine of the direction's angle with the plane of the cylinder's normals.
double yarn_lobe(double sine, double roughness);

/// Density of the normals of one system's filaments at a half vector, 1/sr: the sum over its
/// slopes, each of which stands for the slopes between its neighbours as well. \param half unit
double yarn_facets(const YarnLobes &lobes, int axis, const glm::dvec3 &half);

/// Fits slopes, roughness and depth of diving to the views with light from straight above; no
/// system gets more surface than a full cover. What more than full covers reflect was inside the
/// filaments: only then there is a diffuse part, in the place of loose filaments. The depth of pits
/// is not seen from above: it follows from how little of the face a system has. Throws Error unless
/// f0 is in (0, 1].
YarnLobes fit_yarn_lobes(const Bard &bard, double f0, const Progress &progress = {});

/// Filaments that were fitted to views under oblique light too, if those are of use.
struct ObliqueFit {
    YarnLobes lobes{};
    bool kept = false; ///< fitted to all views; else to those from above alone
    /// Error at lights that were left out of the fit, as ErrorMeasures::l2_cos: of fits to all
    /// other views, and of the fit to those from above. Means of the lights by their views; a light
    /// has 1, the error of black, at most.
    double left_out_l2_cos = 0, from_above_l2_cos = 0;
};

/// Fits the depth of pits as well, which light from straight above does not show, to the rows of
/// the table with oblique light; its rows with theta_i = 0 are not looked at. A dozen rows are
/// enough. Rows of the table and views of the bard count alike, but less the larger their standard
/// error is over a tenth of the light's root mean square; of the views from above all together.
///
/// The fit is kept only where it predicts: each light, with those that the symmetry makes equal to
/// it, is left out in turn, and the fits to the others must be nearer to those left out than the
/// fit to views from above, in the mean. So one light alone is never kept. Takes about a second of
/// a processor for six lights with two rows each. Throws Error naming `where`: less than 4 oblique
/// rows; a light whose views are all 0, or a bard of zeros; as check_table; f0 as above;
/// Interrupted where progress asks to stop.
ObliqueFit fit_yarn_lobes(const Bard &bard, const ReflectanceTable &table, double f0,
                          const std::string &where, const Progress &progress = {});

} // namespace tsuya

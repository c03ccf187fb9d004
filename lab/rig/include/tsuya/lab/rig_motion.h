#pragma once
/// \file
/// From a pair of directions to the positions of the rig's axes.

#include "tsuya/lab/rig_file.h"
#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// Angles or positions of the axes, by AxisName.
using AxisAngles = std::array<double, kAxes>;

/// The angles of the axes in degrees for the directions of a pair, azimuths from above -180 to 180:
/// stage -phi_r, lamp_phi phi_i - phi_r, camera theta_r, lamp_theta theta_i.
AxisAngles axis_angles_deg(const DirectionPair &pair);

/// The angle between lamp and camera in degrees.
double separation_deg(const DirectionPair &pair);

/// The positions of the drives for a pair, of an azimuth the turn that lies nearest to `from`.
/// Throws Error, with `where` = `axes.NAME` or `geometry.dead_cone_deg`, listing every axis that
/// does not reach so far, and a lamp and a camera nearer to each other than the dead cone.
AxisAngles positions_deg(const RigFile &rig, const DirectionPair &pair, const AxisAngles &from);

} // namespace tsuya::lab

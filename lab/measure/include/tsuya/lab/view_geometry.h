#pragma once
/// \file
/// What the size of lamp, lens, lit spot and patch, and the height of the white standard, do to a
/// measured value.

#include <vector>

#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// The length on the cloth, along the plane of view, of a patch of `side_mm` seen from theta_r:
/// side_mm / cos(theta_r).
double patch_length_mm(double side_mm, double theta_r);

/// The length on the cloth of a lit spot of `spot_mm` across the beam, in the direction of the
/// plane of view: longest where that is the plane of incidence, spot_mm / cos(theta_i).
double spot_length_mm(double spot_mm, const DirectionPair &directions);

/// Irradiance of a surface `height_mm` above the cloth's plane over that in the plane, at the point
/// that the camera looks at. The camera's axis meets a raised surface height tan(theta_r) nearer to
/// the camera, the lamp's axis height tan(theta_i) nearer to the lamp: the spot is seen off its
/// middle. Across the beam it is Gaussian with the full width `spot_mm` at half its height; and the
/// lamp, `lamp_mm` from the cloth, is nearer by height cos(theta_i). A width or distance of 0 is
/// unknown, and its part left out.
///
/// Seen from 75 degrees under light from above, 1 mm shifts by tan(75) = 3.73 mm, which costs
/// 1 - 2^-(2 x 3.73 / 30)^2 = 4.2 % in a spot of 30 mm. How the width is meant matters: were 30 mm
/// the width at 1/e of the light, it would be 6.0 %, at 1/e^2 11.6 %, and where a cosine falls to 0
/// 7.5 %.
double raised_irradiance(double height_mm, double spot_mm, double lamp_mm,
                         const DirectionPair &directions);

/// The full angle of a disk of a diameter at a distance, radians; 0 if either is 0.
double disk_angle(double diameter_mm, double distance_mm);

/// The full width at half maximum of the narrowest lobe in a table, radians: for each light, along
/// each half plane of views that reaches half of the light's largest value, from its own largest to
/// where the value is half of that, twice; linear between the views. pi where no lobe falls so far.
double narrowest_lobe(const ReflectanceTable &table);

} // namespace tsuya::lab

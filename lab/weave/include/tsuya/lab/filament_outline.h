#pragma once
/// \file
/// The outline of a filament's section, in units of Filament::radius: three lobes alike, joined by
/// three sides alike. All are arcs of circles that go over into each other without a corner.

#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

/// The lobes lie in the directions 0, 120 and 240 degrees from the axis, counter-clockwise from the
/// first coordinate; they touch the unit circle. Straight sides make a rounded triangle.
struct FilamentOutline {
    double lobe_radius = 1;         ///< in (0, 1]; the centre is 1 - lobe_radius from the axis
    double lobe_turn = 1.047197551; ///< of the normal from the middle of a lobe to its end, radians
    /// One over the radius of a side: 0 straight, above 0 hollow, below 0 bulging.
    double side_curvature = 0;

    double area() const; ///< over the square of the radius
};

/// The outline of a kind of section; the unit circle where it is round.
/// \param corner_rounding as of FilamentOptics: the radius of the corners of a triangle; of a
/// trilobal section what its hollows lack, which are 0.45 deep where it is 0
FilamentOutline outline_of(FilamentSection section, double corner_rounding);

} // namespace tsuya::lab

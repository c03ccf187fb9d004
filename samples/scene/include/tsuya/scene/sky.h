#pragma once
/// \file
/// Environments without a photograph: gradients and skies.

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/image.h"
#include "tsuya/sdk/scene.h"

namespace tsuya::scene {

/// A picture of radiances for Environment::picture that changes with the elevation alone: from
/// straight down to the horizon and from there to straight up, each linear in the angle.
Image gradient_picture(double below, double horizon, double above);

/// A sky of the CIE standard, [ISO15469]: how bright it is where, beside the zenith, by the place
/// of the sun.
struct Sky {
    int type = 12; ///< 1 to 15: 1 is overcast, 5 the same everywhere, 12 clear with a low turbidity
    double azimuth = -40 * kDegree; ///< of the sun, as scene::direction_at
    /// Of the sun above the horizon, radians, 0 to pi / 2; below, the sky is that of 0.
    double elevation = 45 * kDegree;
    /// Radiance below the horizon; 1 is that of a white diffuser under the sky.
    double ground = 0.2;
};

/// A picture of a sky, without the sun itself: a level white diffuser under it has T = 1.
Image sky_picture(const Sky &sky);

/// Irradiance that an environment gives to a level plane that looks up; of a coloured one, of all
/// its groups.
double level_irradiance(const Environment &environment);

} // namespace tsuya::scene

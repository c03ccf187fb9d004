#pragma once
// What the program virtual_camera looks at, for the tests that know it.

#include <cmath>

#include "tsuya/sdk/directions.h"

namespace tsuya::test {

/// A reflectance in 1/sr that tells every angle of a view apart.
inline double virtual_cloth(const DirectionPair &at) {
    return 0.03 + 0.01 * std::cos(2 * at.theta_r) + 0.008 * std::cos(at.phi_r - 0.4) +
           0.006 * std::sin(at.phi_i + 0.3) * std::sin(at.theta_i);
}

} // namespace tsuya::test

#pragma once
/// \file
/// The one-constant theory of [Kubelka]: an opaque layer of absorption K and scattering S.

#include <cmath>

namespace tsuya {

/// K/S = (1 - R)^2 / (2 R). \param reflectance greater than 0, at most 1
inline double absorption_of(double reflectance) {
    return (1 - reflectance) * (1 - reflectance) / (2 * reflectance);
}

/// The inverse. The square root is taken from the sum so that no digits cancel where K/S is large.
inline double reflectance_of(double k_over_s) {
    return 1 / (1 + k_over_s + std::sqrt(k_over_s * (k_over_s + 2)));
}

} // namespace tsuya

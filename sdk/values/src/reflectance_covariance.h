#pragma once
// How much reflectances of cloth at two wavelengths have in common, from which a basis is fitted.

#include <cmath>

namespace tsuya {

// The covariance of a model of reflectances: the sum of a smooth process, of bands some tens of
// nanometres wide, and of one that is only once differentiable and small, [Rasmussen] Eqs. 4.9 and
// 4.17. The lengths and the share are those with the least mean of CIEDE2000 over random dyes of
// bands and edges in the theory of [Kubelka].
inline double reflectance_covariance(double first_nm, double second_nm) {
    constexpr double kSmoothNm = 48, kRoughNm = 36, kRough = 0.0055;
    const double distance = std::abs(first_nm - second_nm);
    const double smooth = distance / kSmoothNm, rough = std::sqrt(3.0) * distance / kRoughNm;
    return std::exp(-0.5 * smooth * smooth) + kRough * (1 + rough) * std::exp(-rough);
}

} // namespace tsuya

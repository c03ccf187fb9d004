#include "tsuya/lab/filament_outline.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr double kStraight = 1e-3; // curvature that counts as none
constexpr double kThird = kPi / 3;

// Lobes of a radius, and sides that come as near as `waist` to the axis.
FilamentOutline lobes(double radius, double waist) {
    const double out = 1 - radius; // of the centre
    // A side's circle of radius s touches the lobes: its centre is waist + s from the axis
    const double above = out * out - radius * radius + waist * waist - out * waist;
    const double curvature = (1 + radius - 2 * waist) / above;
    if (std::abs(curvature) < kStraight)
        return {.lobe_radius = radius};
    const double centre = waist + 1 / curvature;
    const glm::dvec2 towards =
        (curvature > 0 ? 1.0 : -1.0) *
        glm::dvec2(centre * std::cos(kThird) - out, centre * std::sin(kThird));
    return {radius, std::atan2(towards.y, towards.x), curvature};
}

} // namespace

double FilamentOutline::area() const {
    const double out = 1 - lobe_radius;
    const double lobe = lobe_radius * (lobe_radius * lobe_turn + out * std::sin(lobe_turn));
    // Half a side, from the end of a lobe to the middle
    const glm::dvec2 end{out + lobe_radius * std::cos(lobe_turn),
                         lobe_radius * std::sin(lobe_turn)};
    const double along = end.x * std::cos(kThird) + end.y * std::sin(kThird);
    const double half = end.x * std::sin(kThird) - end.y * std::cos(kThird);
    double hollow = 0;
    if (side_curvature != 0) {
        const double turn = std::asin(half * side_curvature);
        hollow = (turn - std::sin(turn) * std::cos(turn)) / (side_curvature * side_curvature);
    }
    return 3 * (lobe + along * half - hollow);
}

FilamentOutline outline_of(FilamentSection section, double corner_rounding) {
    if (section == FilamentSection::round)
        return {};
    if (section == FilamentSection::triangular)
        return {.lobe_radius = std::clamp(corner_rounding, kSharpestCorner, 1.0)};
    const double depth = kDeepestHollow * (1 - corner_rounding);
    return depth < kStraight ? FilamentOutline{} : lobes(1 / (1 + 4.5 * depth), 1 - depth);
}

} // namespace tsuya::lab

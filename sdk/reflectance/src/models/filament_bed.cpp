#include "tsuya/sdk/detail/filament_bed.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

constexpr int kNodes = FilamentBed::kNodes;
constexpr int kFlanks = 60; // parts of the half circle of a yarn's section
// Distances of neighbouring axes over the diameter. Filaments: all between touching and this
constexpr double kWidestFilaments = 1.2;
constexpr double kYarns = 1.2;

// The angle that bed_angle codes as x.
double angle_of_node(int i) {
    const double x = 2.0 * i / (kNodes - 1) - 1;
    return std::clamp(std::atan2(x, 1 - std::abs(x)), -kPi / 2 + 1e-4, kPi / 2 - 1e-4);
}

// The ray in direction `ray` from the point of a unit circle with normal `normal` clears the next
// circle, whose axis lies 2 `distance` away at a right angle to `up`, if 2 distance cos(ray - up) +
// sin|ray - normal| >= 1. Returns the least such distance.
double least_distance(double ray, double normal, double up) {
    const double c = std::cos(ray - up);
    if (std::cos(ray - normal) <= 0 || c <= 0)
        return 1e30;
    return (1 - std::sin(std::abs(ray - normal))) / (2 * c);
}

// Share of the filaments on the part of the yarn with normal `up` that see both.
double seen(double light, double viewer, double up) {
    const double normal = 0.5 * (light + viewer);
    const double least =
        std::max(least_distance(light, normal, up), least_distance(viewer, normal, up));
    return std::clamp((kWidestFilaments - least) / (kWidestFilaments - 1), 0.0, 1.0);
}

// The flank with normal `up` is not behind the next yarn.
bool is_clear(double ray, double up) {
    return 2 * kYarns * std::cos(ray) + std::sin(std::abs(ray - up)) >= 1;
}

double share(double light, double viewer, double flank) {
    double sum = 0;
    for (int i = 0; i < kFlanks; ++i) {
        const double up = kPi * ((i + 0.5) / kFlanks - 0.5);
        if (is_clear(light, up) && is_clear(viewer, up))
            sum += seen(light, viewer, up);
    }
    return (1 - flank) * seen(light, viewer, 0) + flank * sum / kFlanks;
}

} // namespace

FilamentBed::FilamentBed(double flank)
    : value_(static_cast<std::size_t>(kLine * kLine + 1)) { // four are read where three are used
    const auto node = [](int i) { return std::clamp(i - 1, 0, kNodes - 1); };
    std::vector<float> values(static_cast<std::size_t>(kNodes * kNodes));
    for (int i = 0; i < kNodes; ++i)
        for (int j = 0; j <= i; ++j) {
            const auto value = static_cast<float>(share(angle_of_node(i), angle_of_node(j), flank));
            values[static_cast<std::size_t>(i * kNodes + j)] = value;
            values[static_cast<std::size_t>(j * kNodes + i)] = value;
        }
    for (int i = 0; i < kLine; ++i)
        for (int j = 0; j < kLine; ++j)
            value_[static_cast<std::size_t>(i * kLine + j)] =
                values[static_cast<std::size_t>(node(i) * kNodes + node(j))];
}

} // namespace tsuya

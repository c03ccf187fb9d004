#pragma once
// Filaments whose reflectance is known, for the tests of the goniometer.

#include <cmath>
#include <numbers>
#include <vector>

#include "tsuya/lab/goniometer.h"
#include "tsuya/sdk/angle.h"

namespace tsuya::lab {

/// Straight round filaments along the warp, far apart: one of radius 10 um every 0.4 mm.
inline FilamentRepeat far_cylinders(const FilamentOptics &optics) {
    FilamentRepeat repeat;
    repeat.size = {400e-6, 300e-6};
    repeat.filaments = {{.point = {{50e-6f, 0, 0}, {50e-6f, 100e-6f, 0}, {50e-6f, 200e-6f, 0}},
                         .turn = {},
                         .radius = 10e-6f,
                         .system = 0,
                         .yarn = 0}};
    repeat.optics = {optics, optics};
    repeat.name = "cylinders far apart";
    return repeat;
}

/// Two layers of straight filaments close together, warp over weft.
inline FilamentRepeat close_layers(const FilamentOptics &optics) {
    constexpr int kEach = 4;
    constexpr float kStep = 21e-6f;
    FilamentRepeat repeat;
    repeat.size = {kEach * kStep, kEach * kStep};
    repeat.optics = {optics, optics};
    for (std::uint32_t system = 0; system < 2; ++system)
        for (std::uint32_t k = 0; k < kEach; ++k) {
            Filament f{.point = {}, .turn = {}, .radius = 10e-6f, .system = system, .yarn = k};
            for (int i = 0; i < kEach; ++i) {
                const float along = static_cast<float>(i) * kStep;
                const float across = (static_cast<float>(k) + 0.5f) * kStep;
                f.point.push_back(system == 0 ? glm::vec3(across, along, 11e-6f)
                                              : glm::vec3(along, across, -11e-6f));
            }
            repeat.filaments.push_back(f);
        }
    repeat.name = "two layers";
    return repeat;
}

/// Views every `step_deg` in both angles, in the middles of their cells, with their solid angles.
struct ViewGrid {
    std::vector<DirectionPair> pairs{};
    std::vector<double> solid_angle{};

    ViewGrid(double theta_i_deg, double phi_i_deg, double step_deg) {
        for (double t = 0.5 * step_deg; t < 90; t += step_deg)
            for (double p = 0.5 * step_deg; p < 360; p += step_deg) {
                pairs.push_back(
                    {theta_i_deg * kDegree, phi_i_deg * kDegree, t * kDegree, p * kDegree});
                const double half = 0.5 * step_deg * kDegree;
                solid_angle.push_back(
                    (std::cos(t * kDegree - half) - std::cos(t * kDegree + half)) * step_deg *
                    kDegree);
            }
    }
};

/// Largest |z| that `count` independent standard normal numbers may have, for one false alarm in
/// 1 / `chance` runs (Sidak).
inline double sidak_bound(std::size_t count, double chance = 1e-3) {
    const double each = 1 - std::pow(1 - chance, 1.0 / static_cast<double>(count));
    double low = 0, high = 40;
    for (int i = 0; i < 100; ++i) {
        const double middle = 0.5 * (low + high);
        (std::erfc(middle / std::numbers::sqrt2) > each ? low : high) = middle;
    }
    return high;
}

} // namespace tsuya::lab

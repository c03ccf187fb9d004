// The goniometer on a flat sheet: filaments of triangular section side by side, flat sides up.

#include <gtest/gtest.h>

#include "lab/filament_samples.h"
#include "rough_surface.h"
#include "tsuya/lab/goniometer.h"

namespace tsuya::lab {
namespace {

using std::numbers::pi;

// From filament to filament, metres. A side is 17.0 um long, and the corners have a radius of 0.2:
// the top is one plane; corners are within the neighbours.
constexpr float kStep = 15e-6f;

/// Along the warp. \param lean of the sides from the plane of the sheet, radians
FilamentRepeat sheet(FilamentOptics optics, double lean = 0) {
    constexpr float kRadius = 10e-6f;
    constexpr int kCount = 4;
    optics.section = FilamentSection::triangular;
    optics.corner_rounding = 0;
    FilamentRepeat repeat;
    repeat.size = {kCount * kStep, 100e-6};
    repeat.optics = {optics, optics};
    repeat.name = "sheet";
    const auto turn = static_cast<float>(pi / 6 + lean); // a side's normal is half way between two
    for (std::uint32_t k = 0; k < kCount; ++k) {         // corners
        const float x = (static_cast<float>(k) + 0.5f) * kStep;
        repeat.filaments.push_back({.point = {{x, 0, 0}, {x, 50e-6f, 0}},
                                    .turn = {turn, turn},
                                    .radius = kRadius,
                                    .system = 0,
                                    .yarn = k});
    }
    return repeat;
}

/// Largest |z| of what the sheet reflects against Fresnel's share of another index.
double fresnel_z(const FilamentRepeat &repeat, double refractive_index) {
    double largest = 0;
    for (const double theta : {0.0, 30.0, 60.0, 75.0}) {
        const Measurement m =
            measure(repeat, {.pairs = {{theta * kDegree, 0.7, 0, 0}}}, {.photons = 1 << 18});
        const double expected = fresnel(std::cos(theta * kDegree), refractive_index);
        // 0.1 %: the slopes of the roughness
        const double sigma = std::hypot(m.lights[0].reflected_sigma, 0.001 * expected);
        largest = std::max(largest, std::abs(m.lights[0].reflected - expected) / sigma);
    }
    return largest;
}

TEST(Sheet, OfAMirrorGivesFresnel) {
    const FilamentRepeat mirror = sheet({.refractive_index = 1.6, .surface_roughness = 0.005});
    EXPECT_LT(fresnel_z(mirror, 1.6), sidak_bound(4));
    EXPECT_GT(fresnel_z(mirror, 1.62), sidak_bound(4)) << "control";
    const FilamentRepeat leaning =
        sheet({.refractive_index = 1.6, .surface_roughness = 0.005}, 0.2);
    EXPECT_GT(fresnel_z(leaning, 1.6), sidak_bound(4)) << "control";
}

/// Largest |z| of views about the mirror direction against the facets' closed form [Walter], whose
/// roughness is `slope`.
double lobe_z(double measured_slope, double slope) {
    const FilamentOptics optics{.refractive_index = 1.6, .surface_roughness = measured_slope};
    double largest = 0;
    for (const double theta : {0.0, 40.0}) {
        Directions directions;
        for (const double along : {-4.0, -2.0, 0.0, 2.0, 4.0})
            for (const double across : {0.0, 3.0})
                directions.pairs.push_back(
                    {theta * kDegree, pi / 2, std::abs(theta + along) * kDegree,
                     (theta + along < 0 ? pi / 2 : -pi / 2) + across * kDegree});
        const Measurement m = measure(sheet(optics), directions, {.photons = 1 << 19});
        for (const ReflectanceRow &row : m.table.rows) {
            const glm::dvec3 light{0, std::sin(row.theta_i), std::cos(row.theta_i)};
            const glm::dvec3 view{std::sin(row.theta_r) * std::cos(row.phi_r),
                                  std::sin(row.theta_r) * std::sin(row.phi_r),
                                  std::cos(row.theta_r)};
            const glm::dvec3 h = glm::normalize(light + view);
            const double tan2 = 1 / (h.z * h.z) - 1;
            const double d =
                std::exp(-tan2 / (2 * slope * slope)) / (2 * pi * slope * slope * std::pow(h.z, 4));
            const double expected = d * fresnel(glm::dot(light, h), 1.6) / (4 * light.z * view.z);
            const double sigma = std::hypot(row.sigma_per_sr, 0.001 * expected);
            largest = std::max(largest, std::abs(row.brdf_per_sr - expected) / sigma);
        }
    }
    return largest;
}

TEST(Sheet, OfAGlossHasTheLobeOfItsFacets) {
    EXPECT_LT(lobe_z(0.05, 0.05), sidak_bound(20));
    EXPECT_GT(lobe_z(0.05, 0.052), sidak_bound(20)) << "control";
}

/// Largest |z| of views all around against `factor` times what the surface sends there, several
/// reflections in its roughness included.
double rough_z(double factor) {
    const FilamentOptics optics{.refractive_index = 1.6, .surface_roughness = 0.5};
    const RoughSurface surface(optics);
    double largest = 0;
    for (const double theta : {0.0, 45.0, 80.0}) {
        Directions directions;
        for (const double theta_r : {0.0, 30.0, 60.0, 80.0})
            for (double phi = 0; phi < 360; phi += 90)
                directions.pairs.push_back({theta * kDegree, 0, theta_r * kDegree, phi * kDegree});
        const Measurement m = measure(sheet(optics), directions, {.photons = 1 << 19});
        const glm::vec3 light(std::sin(theta * kDegree), 0, std::cos(theta * kDegree));
        for (const ReflectanceRow &row : m.table.rows) {
            const glm::vec3 view(std::sin(row.theta_r) * std::cos(row.phi_r),
                                 std::sin(row.theta_r) * std::sin(row.phi_r),
                                 std::cos(row.theta_r));
            const double expected =
                factor *
                (surface.single_per_sr(light, view) + surface.multiple_per_sr(light.z, view.z)) /
                view.z;
            const double sigma = std::hypot(row.sigma_per_sr, 0.001 * expected);
            largest = std::max(largest, std::abs(row.brdf_per_sr - expected) / sigma);
        }
    }
    return largest;
}

TEST(Sheet, OfARoughSurfaceGivesWhatTheSurfaceEvaluates) {
    EXPECT_LT(rough_z(1), sidak_bound(48));
    EXPECT_GT(rough_z(1.03), sidak_bound(48)) << "control";
}

} // namespace
} // namespace tsuya::lab

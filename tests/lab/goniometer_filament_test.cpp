// Light through filaments, against what is known of smooth cylinders and of any boundary.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "filament_cell.h"
#include "filament_gap.h"
#include "lab/filament_samples.h"
#include "photon_walk.h"
#include "rough_dielectric.h"
#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/weave_geometry.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

constexpr double kIndex = 1.55;
using Normals = RoughDielectric::Normals;

/// Light that meets a smooth cylinder: shares of it by the turn at which it leaves, seen along the
/// axis. 0 is straight back. [Marschner] in the plane across; inclined light by Bravais' index,
/// with Fresnel's term for the directions as they are in space.
struct Cylinder {
    double inclination; ///< of the light to the plane across the axis, radians
    double transmission;
    std::vector<double> share = std::vector<double>(kBins, 0.0);
    double all = 0; ///< shares of all turns
    static constexpr int kBins = 36;

    Cylinder(double inclined, double of_a_diameter)
        : inclination(inclined), transmission(of_a_diameter) {
        constexpr int kSteps = 400000, kMostPasses = 60;
        const double across = std::cos(inclination);
        const double within = std::sqrt(1 - std::pow(std::sin(inclination) / kIndex, 2));
        const double bravais = kIndex * within / across;
        for (int i = 0; i < kSteps; ++i) {
            const double h = 2 * (i + 0.5) / kSteps - 1, gamma = std::asin(h);
            const double gamma_t = std::asin(h / bravais);
            const double f = fresnel(across * std::cos(gamma), kIndex);
            const double chord =
                std::pow(transmission, std::cos(gamma_t) / within); // a diameter is 1
            add(2 * gamma, f / kSteps);
            double energy = (1 - f) * chord;
            double turn = 2 * gamma - 2 * gamma_t + kPi; // of p = 1
            for (int p = 1; p < kMostPasses; ++p) {
                add(turn, energy * (1 - f) / kSteps);
                energy *= f * chord;
                turn += kPi - 2 * gamma_t;
            }
        }
    }
    void add(double turn, double amount) {
        const double t = turn / (2 * kPi) + 0.5;
        share[static_cast<std::size_t>((t - std::floor(t)) * kBins) % kBins] += amount;
        all += amount;
    }
};

constexpr double kCover = 20.0 / 400; ///< of far_cylinders

/// Largest |z| of bins of the turn, of views above the cloth, against a cylinder of another
/// transmission. The light stands `theta` from above, in the plane of the axis or across it.
double cylinder_z(double theta, bool along, double transmission, double expected_transmission) {
    const FilamentOptics optics{
        .refractive_index = kIndex, .surface_roughness = 0.006, .transmission = transmission};
    const double inclined = along ? theta : 0;
    const Cylinder cylinder(inclined, expected_transmission);
    constexpr double kTurnStep = 0.02, kOffStep = 0.015;
    const double bin = 2 * kPi / Cylinder::kBins;
    double largest = 0;
    for (int b = 1; b < Cylinder::kBins - 1; b += 2) {
        // Turns are counted from straight back to the light, which is `theta` from above
        const double first = (b - 0.5 * Cylinder::kBins) * bin;
        Directions directions;
        std::vector<double> weight;
        const int steps = static_cast<int>(std::round(bin / kTurnStep));
        for (int i = 0; i < steps; ++i)
            for (int j = -5; j <= 5; ++j) {
                const double turn = first + (i + 0.5) * bin / steps + (along ? 0 : theta);
                const double off = -inclined + j * kOffStep;
                const glm::dvec3 v{std::cos(off) * std::sin(turn), std::sin(off),
                                   std::cos(off) * std::cos(turn)};
                if (v.z < 0.05)
                    continue;
                directions.pairs.push_back(
                    {theta, along ? kPi / 2 : 0, std::acos(v.z), std::atan2(v.y, v.x)});
                weight.push_back(v.z * std::cos(off) * kOffStep * bin / steps);
            }
        if (weight.size() != static_cast<std::size_t>(11 * steps))
            continue;
        const Measurement m = measure(far_cylinders(optics), directions, {.photons = 1 << 18});
        double sum = 0, variance = 0;
        for (std::size_t i = 0; i < weight.size(); ++i) {
            sum += m.table.rows[i].brdf_per_sr * weight[i];
            variance += std::pow(m.table.rows[i].sigma_per_sr * weight[i], 2);
        }
        // Of the cylinder as wide as it is seen: across, it covers 1 / cos(theta) of what it does
        const double seen = along ? kCover : kCover / std::cos(theta);
        const double expected = seen * cylinder.share[static_cast<std::size_t>(b)];
        // Neighbouring views see the same photons; 2 %: roughness moves light from bin to bin
        const double sigma = std::hypot(2 * std::sqrt(variance), 0.02 * expected) + 2e-6;
        largest = std::max(largest, std::abs(sum - expected) / sigma);
    }
    return largest;
}

TEST(ClearCylinder, HasTheAnalyticDistributionAroundItsAxis) {
    EXPECT_LT(cylinder_z(0.001, true, 1, 1), 4);
    EXPECT_LT(cylinder_z(0.001, true, 0.5, 0.5), 4);
    EXPECT_GT(cylinder_z(0.001, true, 0.5, 0.9), 4) << "control";
}

TEST(ClearCylinder, SendsLightIntoTheConeOfTheLight) {
    EXPECT_LT(cylinder_z(0.7, true, 0.5, 0.5), 4);
    EXPECT_GT(cylinder_z(0.7, true, 0.5, 0.9), 4) << "control";
    // Beside the cone there is nothing: views 0.3 off it, all around
    Directions on, off;
    for (double turn = -1.2; turn <= 1.2; turn += 0.02)
        for (const double inclination : {-0.7, -0.4}) {
            const glm::dvec3 v{std::cos(inclination) * std::sin(turn), std::sin(inclination),
                               std::cos(inclination) * std::cos(turn)};
            (inclination < -0.5 ? on : off)
                .pairs.push_back({0.7, kPi / 2, std::acos(v.z), std::atan2(v.y, v.x)});
        }
    const FilamentOptics optics{
        .refractive_index = kIndex, .surface_roughness = 0.006, .transmission = 0.8};
    const auto mean = [&](const Directions &directions) {
        double sum = 0;
        for (const ReflectanceRow &row :
             measure(far_cylinders(optics), directions, {.photons = 1 << 18}).table.rows)
            sum += row.brdf_per_sr;
        return sum / static_cast<double>(directions.pairs.size());
    };
    EXPECT_LT(mean(off), 1e-3 * mean(on));
}

TEST(ClearCylinder, AbsorbsAlongTheChord) {
    // Beer's law over all chords: what is neither reflected nor transmitted, of what is met
    for (const double theta : {0.0, 0.8})
        for (const double transmission : {0.3, 0.8}) {
            const FilamentOptics optics{.refractive_index = kIndex,
                                        .surface_roughness = 0.005,
                                        .transmission = transmission};
            const Measurement m = measure(
                far_cylinders(optics), {.pairs = {{theta, kPi / 2, 0, 0}}}, {.photons = 1 << 20});
            const LightReport &light = m.lights[0];
            const double lost = 1 - light.reflected - light.transmitted;
            const double expected = kCover * (1 - Cylinder(theta, transmission).all);
            // Nearer to the truth than to a transmission that is off by 5 %
            const double wrong = kCover * (1 - Cylinder(theta, 0.95 * transmission).all);
            EXPECT_NEAR(lost, expected, 0.4 * std::abs(wrong - expected)) << theta;
            EXPECT_GT(std::abs(lost - wrong), 0.4 * std::abs(wrong - expected)) << "control";
        }
}

/// Share of parallel light that comes through a cylinder that neither bends nor reflects it, of
/// optical depth x across a diameter: Beer's law over chords cos(g) of a diameter, integral of
/// exp(-x cos g) cos g over g from 0 to pi/2, term by term.
double through_cylinder(double x) {
    double cosines[] = {1, kPi / 4}; // integrals of cos g, cos^2 g, and so on
    double sum = 0, term = 1;
    for (int k = 0; k < 60; ++k) {
        sum += term * cosines[k % 2];
        term *= -x / (k + 1);
        cosines[k % 2] *= (k + 2.0) / (k + 3);
    }
    return sum;
}

TEST(ClearCylinder, ObeysBeersLaw) {
    // An index that hardly bends or reflects, below those that a measurement takes
    constexpr double kHardly = 1.002;
    for (const double depth : {0.5, 1.0, 2.0, 4.0}) {
        const FilamentOptics optics{.refractive_index = kHardly,
                                    .surface_roughness = 0.005,
                                    .transmission = std::exp(-depth)};
        const FilamentScene scene(FilamentCell(far_cylinders(optics), 0.02, 24), {});
        const std::vector<FilamentMatter> matter{FilamentMatter(optics), FilamentMatter(optics)};
        const LightViews light({0, 0, 1}, {glm::vec3(0, 0, 1)}, matter);
        Sums sums(1);
        constexpr int kBatches = 128;
        for (std::uint32_t batch = 0; batch < kBatches; ++batch)
            walk(scene, matter, light, {}, Random(1, 0, batch), sums);
        const double lost = 1 - (sums.transmitted + sums.reflected) / (kBatches * kPhotonsPerBatch);
        const double through = 1 - lost / kCover;
        EXPECT_NEAR(through, through_cylinder(depth), 0.01) << depth;
        EXPECT_GT(std::abs(through - std::exp(-depth)), 0.01) << "control: all of a diameter";
        if (depth >= 1) {
            EXPECT_GT(std::abs(through - std::exp(-depth * kPi / 4)), 0.01)
                << "control: all of the mean chord";
        }
    }
}

/// Largest |z| of pairs of directions there and back, to 75 degrees, of `batches` batches of
/// photons each. `factor` multiplies the way back.
double reciprocity_z(const FilamentRepeat &repeat, Normals normals, int batches = 6,
                     double factor = 1) {
    constexpr int kPairs = 12;
    const FilamentScene scene(FilamentCell(repeat, 0.02, 24), {});
    std::vector<FilamentMatter> matter;
    for (const FilamentOptics &optics : repeat.optics)
        matter.emplace_back(optics, normals);
    std::mt19937 generator(17);
    std::uniform_real_distribution<double> unit;
    const auto run = [&](const glm::vec3 &light, const glm::vec3 &view, std::uint32_t seed) {
        const LightViews views(light, {view}, matter);
        Sums sums(1);
        for (int batch = 0; batch < batches; ++batch)
            walk(scene, matter, views, {}, Random(seed, 0, static_cast<std::uint32_t>(batch)),
                 sums);
        const double n = static_cast<double>(batches * kPhotonsPerBatch), mean = sums.value[0] / n;
        return glm::dvec2(mean, std::sqrt((sums.square[0] / n - mean * mean) / n));
    };
    double largest = 0;
    for (std::uint32_t i = 0; i < kPairs; ++i) {
        // Half of the pairs have a direction at 60 to 75 degrees
        const double steep = (i % 2 == 0 ? 60 + 15 * unit(generator) : 60 * unit(generator));
        const glm::vec3 a = direction_of(steep * kDegree, 6.28 * unit(generator));
        const glm::vec3 b = direction_of(75 * unit(generator) * kDegree, 6.28 * unit(generator));
        const glm::dvec2 there = run(a, b, 2 * i), back = run(b, a, 2 * i + 1);
        largest = std::max(largest, std::abs(there.x - factor * back.x) /
                                        std::hypot(there.y, factor * back.y));
    }
    return largest;
}

TEST(ClearFilaments, AreReciprocal) {
    for (const FilamentSection section :
         {FilamentSection::round, FilamentSection::triangular, FilamentSection::trilobal}) {
        const FilamentRepeat layers = close_layers({.section = section,
                                                    .refractive_index = kIndex,
                                                    .surface_roughness = 0.2,
                                                    .transmission = 0.9});
        EXPECT_LT(reciprocity_z(layers, Normals::visible), sidak_bound(12))
            << static_cast<int>(section);
        if (section != FilamentSection::round)
            continue;
        EXPECT_GT(reciprocity_z(layers, Normals::visible, 6, 1.5), sidak_bound(12)) << "control";
        // Three times the photons: a control that only just sees the fault would fail by chance
        EXPECT_GT(reciprocity_z(layers, Normals::all, 18), sidak_bound(12)) << "control";
    }
}

/// Largest |z| of the values and energies of `a` + `b` against those of `all`.
double sum_z(const Measurement &a, const Measurement &b, const Measurement &all) {
    double largest = 0;
    for (std::size_t i = 0; i < all.table.rows.size(); ++i) {
        const ReflectanceRow &x = a.table.rows[i], &y = b.table.rows[i], &z = all.table.rows[i];
        const double sigma = std::hypot(std::hypot(x.sigma_per_sr, y.sigma_per_sr), z.sigma_per_sr);
        largest =
            std::max(largest, std::abs(x.brdf_per_sr + y.brdf_per_sr - z.brdf_per_sr) / sigma);
    }
    return largest;
}

TEST(Parts, AreSurfaceAndBody) {
    const Directions directions{.pairs = ViewGrid(40, 70, 30).pairs};
    const FilamentRepeat dyed = close_layers({.transmission = 0.8});
    GoniometerSettings settings{.photons = 1 << 17, .part = LightPart::surface};
    const Measurement surface = measure(dyed, directions, settings);
    settings.part = LightPart::body;
    settings.seed = 2;
    const Measurement body = measure(dyed, directions, settings);
    settings.part = LightPart::all;
    settings.seed = 3;
    const Measurement all = measure(dyed, directions, settings);
    EXPECT_LT(sum_z(surface, body, all), sidak_bound(36));
    EXPECT_GT(sum_z(surface, surface, all), sidak_bound(36)) << "control";
    EXPECT_NEAR(surface.lights[0].reflected + body.lights[0].reflected, all.lights[0].reflected,
                4 * (body.lights[0].reflected_sigma + all.lights[0].reflected_sigma));
    // Black filaments have no body
    settings.part = LightPart::body;
    const Measurement black = measure(close_layers({}), directions, settings);
    EXPECT_EQ(black.lights[0].reflected, 0);
    EXPECT_EQ(black.table.rows[0].brdf_per_sr, 0);
    const Measurement whole = measure(close_layers({}), directions, {.photons = 1 << 15});
    const Measurement as_surface =
        measure(close_layers({}), directions, {.photons = 1 << 15, .part = LightPart::surface});
    EXPECT_EQ(whole.table.rows[5].brdf_per_sr, as_surface.table.rows[5].brdf_per_sr);
}

TEST(Delustrant, TurnsLightByItsMeanCosine) {
    Random random(1, 2, 3);
    const glm::vec3 ahead = direction_of(1, 2);
    for (const double g : {0.0, 0.69, -0.5}) {
        double sum = 0;
        constexpr int kCount = 200000;
        for (int i = 0; i < kCount; ++i)
            sum += glm::dot(ahead, scattered(ahead, g, random)) / kCount;
        EXPECT_NEAR(sum, g, 5e-3);
    }
}

TEST(Delustrant, KeepsLightAndTurnsItBack) {
    for (const FilamentSection section : {FilamentSection::round, FilamentSection::triangular}) {
        FilamentOptics optics{.section = section, .transmission = 1};
        const auto report = [&] {
            return measure(close_layers(optics), {.pairs = {{0.3, 0.4, 0, 0}}},
                           {.photons = 1 << 14})
                .lights[0];
        };
        const LightReport bright = report();
        optics.scattering_length = 2e-6; // 10 events a diameter, to all sides alike
        const LightReport dull = report();
        EXPECT_NEAR(dull.reflected + dull.transmitted, 1, 1e-12);
        EXPECT_GT(dull.reflected, bright.reflected + 4 * bright.reflected_sigma);
        optics.transmission = 0.999; // control: longer ways within
        EXPECT_LT(report().reflected + report().transmitted, 1 - 1e-4);
    }
    const FilamentRepeat dull = close_layers({.refractive_index = kIndex,
                                              .surface_roughness = 0.1,
                                              .transmission = 0.95,
                                              .scattering_length = 10e-6,
                                              .scattering_anisotropy = 0.69});
    EXPECT_LT(reciprocity_z(dull, Normals::visible), sidak_bound(12));
}

TEST(ClearFilaments, AreKeptApart) {
    FilamentRepeat repeat = close_layers({.transmission = 0.5});
    for (Filament &f : repeat.filaments)
        f.radius = 10.6e-6f; // 21 um apart
    const FilamentCell cell(repeat, 0.02, 24);
    EXPECT_LT(cell.thinning, 0.99);
    EXPECT_NEAR(cell.gap, kLeastGap, 1e-6);
    // The gap is that of the filaments as they are traced
    FilamentRepeat thinner = repeat;
    for (Filament &f : thinner.filaments)
        f.radius *= static_cast<float>(cell.thinning);
    EXPECT_NEAR(FilamentCell(thinner, 0.02, 24).thinning, 1, 1e-5);
    for (FilamentOptics &o : repeat.optics)
        o.transmission = 0;
    EXPECT_EQ(FilamentCell(repeat, 0.02, 24).thinning, 1) << "black ones stay as they are";
    for (FilamentOptics &o : repeat.optics)
        o.transmission = 0.5;
    for (Filament &f : repeat.filaments)
        f.radius = 14e-6f;
    EXPECT_THROW(FilamentCell(repeat, 0.02, 24), Error);
}

/// Least gap of the rods of a cell, whatever the cell itself says of it.
double gap_of(const FilamentCell &cell) {
    std::vector<Capsule> capsules;
    for (std::size_t i = 0; i < cell.cones.first.size(); ++i) {
        const glm::vec4 &from = cell.cones.vertex[cell.cones.first[i]];
        const glm::vec4 &to = cell.cones.vertex[cell.cones.first[i] + 1];
        capsules.push_back({glm::vec3(from), glm::vec3(to), from.w, cell.cones.strand[i]});
    }
    return least_gap(capsules);
}

TEST(ClearFilaments, OfWeavesAreApartAlongCrossingsToo) {
    for (const std::string &name : weave_names()) {
        Weave cloth = weave(name);
        for (Yarn *yarn : {&cloth.warp, &cloth.weft}) {
            yarn->section = FilamentSection::round; // the circle about any section
            yarn->transmission = {0, 0, 0};         // as they are built, not thinned
        }
        FilamentRepeat repeat = build_filaments(cloth);
        EXPECT_GT(gap_of(FilamentCell(repeat, 0.02, 24)), 0) << name;
        // Control: yarns moved into each other by a quarter of a filament
        for (Filament &f : repeat.filaments)
            for (glm::vec3 &p : f.point)
                p.z += f.system == 0 ? -0.5f * f.radius : 0;
        EXPECT_LT(gap_of(FilamentCell(repeat, 0.02, 24)), 0) << name;
    }
}

} // namespace
} // namespace tsuya::lab

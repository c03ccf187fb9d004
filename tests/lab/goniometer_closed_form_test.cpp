// The goniometer against what is known without it.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "lab/filament_samples.h"
#include "rough_surface.h"
#include "tsuya/lab/goniometer.h"
#include "view_tree.h"

namespace tsuya::lab {
namespace {

using std::numbers::pi;

glm::dvec3 toward(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// [Walter] Smith's G1 of Beckmann's distribution, in their rational form.
double rational_g1(double cosine, double slope) {
    const double a = cosine / (std::sqrt(1 - cosine * cosine) * slope * std::numbers::sqrt2);
    return a < 1.6 ? (3.535 * a + 2.181 * a * a) / (1 + 2.276 * a + 2.577 * a * a) : 1;
}

/// Reflectance of far_cylinders by a sum over the turn of the normal about the axis.
double cylinder_brdf(const DirectionPair &p, const FilamentOptics &optics) {
    constexpr double kRadius = 10e-6, kSpacing = 400e-6;
    constexpr int kSteps = 20000;
    const glm::dvec3 light = toward(p.theta_i, p.phi_i), view = toward(p.theta_r, p.phi_r);
    const glm::dvec3 h = glm::normalize(light + view);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double a = 2 * pi * (i + 0.5) / kSteps;
        const glm::dvec3 n{std::cos(a), 0, std::sin(a)};
        const double l = glm::dot(n, light), v = glm::dot(n, view), m = glm::dot(n, h);
        if (l <= 0 || v <= 0 || m <= 0)
            continue;
        const double slope2 = optics.surface_roughness * optics.surface_roughness;
        const double tan2 = 1 / (m * m) - 1;
        const double d = std::exp(-tan2 / (2 * slope2)) / (2 * pi * slope2 * m * m * m * m);
        const double gl = rational_g1(l, optics.surface_roughness);
        const double gv = rational_g1(v, optics.surface_roughness);
        sum += d / (1 / gl + 1 / gv - 1) / 4; // heights correlated
    }
    return sum * fresnel(glm::dot(light, h), optics.refractive_index) * kRadius * 2 * pi / kSteps /
           (kSpacing * light.z * view.z);
}

TEST(Fresnel, OfASmoothBoundary) {
    EXPECT_NEAR(fresnel(1, 1.5), 0.04, 1e-12);
    EXPECT_NEAR(fresnel(0, 1.5), 1, 1e-12);
    // At Brewster's angle half the light has Rs = ((n^2 - 1)/(n^2 + 1))^2, the other half none
    const double n = 1.6, rs = (n * n - 1) / (n * n + 1);
    EXPECT_NEAR(fresnel(1 / std::sqrt(1 + n * n), n), 0.5 * rs * rs, 1e-12);
    EXPECT_NEAR(fresnel(0.3, 1), 0, 1e-12);
}

TEST(RoughSurface, IsAMirrorOfFresnelWhereItIsFlat) {
    const FilamentOptics optics{.refractive_index = 1.6, .surface_roughness = 0.005};
    const RoughSurface surface(optics);
    Random random(1, 2, 3);
    for (const double theta : {0.0, 30.0, 60.0, 80.0}) {
        const glm::vec3 from(toward(theta * kDegree, 1));
        double energy = 0;
        constexpr int kCount = 20000;
        for (int i = 0; i < kCount; ++i) {
            const RoughSurface::Reflection r = surface.sample(from, random);
            energy += r.weight / kCount;
            EXPECT_GT(glm::dot(r.direction, glm::vec3(-from.x, -from.y, from.z)), 0.99f);
        }
        EXPECT_NEAR(energy / fresnel(from.z, 1.6), 1, 4e-3) << theta;
        EXPECT_GT(std::abs(energy / fresnel(from.z, 1.63) - 1), 4e-3) << theta << ", control";
    }
}

/// Largest |z| between counts of sampled directions and the densities times `factor`.
double sampling_z(double theta, double slope, double factor) {
    const RoughSurface surface({.refractive_index = 1.6, .surface_roughness = slope});
    const glm::vec3 from(toward(theta, 0.4));
    constexpr int kRows = 8, kColumns = 12, kCount = 400000, kFine = 40;
    std::vector<double> sum(kRows * kColumns), square(sum.size()), expected(sum.size());
    Random random(5, 6, 7);
    const auto column = [](double x, double y) {
        return std::min(kColumns - 1,
                        static_cast<int>((std::atan2(y, x) / (2 * pi) + 0.5) * kColumns));
    };
    for (int i = 0; i < kCount; ++i) {
        const RoughSurface::Reflection r = surface.sample(from, random);
        const int row = std::min(kRows - 1, static_cast<int>(r.direction.z * kRows));
        const auto k =
            static_cast<std::size_t>(row * kColumns + column(r.direction.x, r.direction.y));
        sum[k] += r.weight;
        square[k] += r.weight * r.weight;
    }
    for (int i = 0; i < kRows * kFine; ++i)
        for (int j = 0; j < kColumns * kFine; ++j) {
            const double mu = (i + 0.5) / (kRows * kFine), s = std::sqrt(1 - mu * mu);
            const double phi = 2 * pi * ((j + 0.5) / (kColumns * kFine) - 0.5);
            const glm::vec3 to(s * std::cos(phi), s * std::sin(phi), mu);
            const double p = surface.single_per_sr(from, to) + surface.multiple_per_sr(from.z, mu);
            expected[static_cast<std::size_t>(i / kFine * kColumns + j / kFine)] +=
                p * 2 * pi / (kRows * kFine) / (kColumns * kFine);
        }
    double largest = 0;
    for (std::size_t k = 0; k < sum.size(); ++k) {
        const double mean = sum[k] / kCount;
        // 2e-5: of the sum over the bin, and of bins that have next to no samples
        const double sigma = std::sqrt((square[k] / kCount - mean * mean) / kCount) + 2e-5;
        largest = std::max(largest, std::abs(mean - factor * expected[k]) / sigma);
    }
    return largest;
}

TEST(RoughSurface, SamplesWhatItEvaluates) {
    for (const double slope : {0.1, 0.3})
        for (const double theta : {0.0, 40.0, 75.0, 87.0}) {
            EXPECT_LT(sampling_z(theta * kDegree, slope, 1), sidak_bound(96)) << theta;
            EXPECT_GT(sampling_z(theta * kDegree, slope, 1.2), sidak_bound(96)) << "control";
        }
}

/// A choice of one of `points` at `centre`, every one equally likely.
ViewTree::Choice even_choice(const std::vector<glm::vec3> &points, Random &random) {
    const auto count = static_cast<float>(points.size());
    return {static_cast<std::uint32_t>(random.unit() * count), 1 / count};
}

/// |z| of the mean of x / probability against the sum of x over all points. \param lie told of the
/// probability, 1 for the truth
double tree_z(double lie) {
    std::vector<glm::vec3> points;
    for (const DirectionPair &p : ViewGrid(0, 0, 15).pairs)
        points.emplace_back(toward(p.theta_r, p.phi_r));
    const ViewTree tree(points, std::vector<float>(points.size(), 1.0f), 0.2f);
    constexpr int kCount = 400000;
    const glm::vec3 centre(toward(0.5, 0.7));
    const auto value = [&](const glm::vec3 &p) {
        return std::exp(-40 * glm::dot(p - centre, p - centre));
    };
    double expected = 0;
    for (const glm::vec3 &p : points)
        expected += value(p);
    double sum = 0, square = 0, even_square = 0;
    Random random(1, 1, 1);
    for (int i = 0; i < kCount; ++i) {
        const ViewTree::Choice c = tree.sample(centre, random), e = even_choice(points, random);
        const double x = value(points[c.index]) / (lie * c.probability);
        const double y = value(points[e.index]) / e.probability;
        sum += x;
        square += x * x;
        even_square += y * y;
    }
    // What the tree is for: less spread than an even choice has
    EXPECT_LT(square, 0.5 * even_square);
    const double mean = sum / kCount;
    return std::abs(mean - expected) / std::sqrt((square / kCount - mean * mean) / kCount);
}

TEST(ViewTree, GivesEveryViewItsChance) {
    EXPECT_LT(tree_z(1), 4);
    EXPECT_GT(tree_z(1.02), 4) << "control";
}

/// Largest |z| of the cylinders' rows against their closed form times `factor`.
double cylinder_z(const DirectionPair &light, double slope, double factor) {
    const FilamentOptics optics{.refractive_index = 1.5, .surface_roughness = slope};
    // Views near the cone about the axis y that the light's mirror images lie on
    Directions directions;
    const double y = std::sin(light.theta_i) * std::sin(light.phi_i);
    for (double turn = -75; turn <= 75; turn += 7.5)
        for (double off = -2; off <= 2; ++off) {
            const double sine = std::clamp(-y + 1.5 * slope * off, -0.99, 0.99);
            const double r = std::sqrt(1 - sine * sine);
            const glm::dvec3 v{r * std::sin(turn * kDegree), sine, r * std::cos(turn * kDegree)};
            directions.pairs.push_back(
                {light.theta_i, light.phi_i, std::acos(v.z), std::atan2(v.y, v.x)});
        }
    const Measurement m = measure(far_cylinders(optics), directions, {.photons = 1 << 23});
    double largest = 0;
    for (std::size_t i = 0; i < m.table.rows.size(); ++i) {
        const ReflectanceRow &row = m.table.rows[i];
        const double expected = factor * cylinder_brdf(directions.pairs[i], optics);
        if (expected < 1e-4)
            continue;
        // 0.4 %: several reflections in the roughness, and the rational form of G1
        const double sigma = std::hypot(row.sigma_per_sr, 0.004 * expected);
        largest = std::max(largest, std::abs(row.brdf_per_sr - expected) / sigma);
    }
    return largest;
}

TEST(Cylinders, ReflectIntoTheConeAboutTheirAxis) {
    for (const DirectionPair &light :
         {DirectionPair{0, 0}, {40 * kDegree, 0}, {40 * kDegree, pi / 2}, {60 * kDegree, 0.7}}) {
        EXPECT_LT(cylinder_z(light, 0.03, 1), sidak_bound(105)) << light.theta_i;
        EXPECT_GT(cylinder_z(light, 0.03, 1.1), sidak_bound(105)) << "control";
    }
}

TEST(Cylinders, HaveTheAnalyticDensityAroundTheCone) {
    // Light across the axis: flux per turn psi of the reflected light is that of the normals at
    // half the turn, r / 2 cos(psi / 2) F(cos(psi / 2)) per spacing
    const FilamentOptics optics{.refractive_index = 1.5, .surface_roughness = 0.02};
    for (const double psi : {-60.0, -20.0, 0.0, 40.0, 70.0}) {
        Directions directions;
        constexpr double kStep = 0.01;
        for (int i = -16; i <= 16; ++i) {
            const glm::dvec3 v{std::cos(kStep * i) * std::sin(psi * kDegree), std::sin(kStep * i),
                               std::cos(kStep * i) * std::cos(psi * kDegree)};
            directions.pairs.push_back({0, 0, std::acos(v.z), std::atan2(v.y, v.x)});
        }
        const Measurement m = measure(far_cylinders(optics), directions, {.photons = 1 << 22});
        double density = 0, variance = 0;
        for (int i = -16; i <= 16; ++i) {
            const ReflectanceRow &row = m.table.rows[static_cast<std::size_t>(i + 16)];
            const double weight = std::cos(row.theta_r) * std::cos(kStep * i) * kStep;
            density += row.brdf_per_sr * weight;
            variance += std::pow(row.sigma_per_sr * weight, 2);
        }
        const double half = std::cos(0.5 * psi * kDegree);
        const double expected = 10e-6 / 400e-6 / 2 * half * fresnel(half, 1.5);
        EXPECT_LT(std::abs(density - expected), 4 * std::sqrt(variance) + 0.005 * expected) << psi;
        EXPECT_GT(std::abs(density - 1.1 * expected), 4 * std::sqrt(variance) + 0.005 * expected)
            << "control";
    }
}

} // namespace
} // namespace tsuya::lab

// Lights of every kind: how they are sampled, and what they give.

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "light_disk.h"
#include "light_point.h"
#include "light_rectangle.h"
#include "light_sphere.h"
#include "light_sun.h"
#include "light_tree.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/light.h"

namespace tsuya::test {
namespace {

constexpr glm::dvec3 kOrigin{0, 0, 0};

// What the sampling of a light promises, whatever its kind.
struct Sampled {
    const char *name;
    std::function<std::optional<LightRay>(glm::vec2)> sample;
    // Density of a direction; 0 where the light is not met
    std::function<float(const glm::vec3 &)> pdf;
    glm::vec3 towards; // its middle
    float cone;        // radians around it that hold the light
    Light light;
};

template <class Traced, class Described>
Sampled near_light(const char *name, const Described &light, const glm::dvec3 &middle, float cone) {
    const Traced traced(light, kOrigin);
    return {name,
            [traced](glm::vec2 u) { return traced.sample(kOrigin, u); },
            [traced](const glm::vec3 &d) {
                const auto distance = traced.crossing(kOrigin, d);
                return distance ? traced.pdf(kOrigin, d, *distance) : 0.0f;
            },
            glm::normalize(middle),
            cone,
            light};
}

Sampled sun(const char *name, const SunLight &light) {
    const LightSun traced(light);
    return {name,
            [traced](glm::vec2 u) { return std::optional(traced.sample(u)); },
            [traced](const glm::vec3 &d) { return traced.is_met(d) ? traced.pdf() : 0.0f; },
            glm::normalize(light.to_light),
            float(light.angular_radius) * 1.2f,
            light};
}

std::vector<Sampled> sampled_lights() {
    const auto disk = [](glm::dvec3 centre, glm::dvec3 direction, double radius) {
        return DiskLight{.centre = centre, .direction = direction, .radius = radius, .radiance = 3};
    };
    return {
        near_light<LightDisk>("disk above", disk({0, 0, 2}, {0, 0, -1}, 0.5), {0, 0, 2}, 0.3f),
        near_light<LightDisk>("disk aside", disk({1, 0.5, 1}, {-1, -0.2, -0.4}, 0.6), {1, 0.5, 1},
                              0.6f),
        near_light<LightDisk>("disk near", disk({0, 0, 0.3}, {0, 0, -1}, 1), {0, 0, 1}, 1.3f),
        near_light<LightSphere>("sphere", SphereLight{.centre = {1, 1, 2}, .radius = 0.4},
                                {1, 1, 2}, 0.2f),
        near_light<LightSphere>("sphere at hand", SphereLight{.centre = {0, 0, 1}, .radius = 0.95},
                                {0, 0, 1}, 1.4f),
        sun("sun", {.to_light = {0.2, 1, 2}}),
        sun("wide sun", {.to_light = {-1, 0, 3}, .angular_radius = 0.7}),
    };
}

// Integral of f over the directions of a light, one by one on a fine grid around it.
double over_directions(const Sampled &light, const std::function<double(const glm::vec3 &)> &f) {
    constexpr int kSteps = 800;
    const double depth = 1 - std::cos(double(light.cone));
    const Frame frame = make_frame(light.towards);
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double c = 1 - depth * (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps;
            const double s = std::sqrt(1 - c * c);
            const glm::vec3 d =
                frame.to_world({float(s * std::cos(phi)), float(s * std::sin(phi)), float(c)});
            sum += f(d);
        }
    return sum * 2 * kPi * depth / kSteps / kSteps;
}

double density_in_all(const Sampled &light) {
    return over_directions(light, [&](const glm::vec3 &d) { return double(light.pdf(d)); });
}

TEST(LightKinds, DensitiesIntegrateToOne) {
    for (const Sampled &light : sampled_lights())
        EXPECT_NEAR(density_in_all(light), 1, 5e-3) << light.name;
    // Negative control: the density of a disk a twentieth larger than the one that is met
    const auto of = [](double radius) {
        return DiskLight{.centre = {0, 0, 2}, .direction = {0, 0, -1}, .radius = radius};
    };
    Sampled wrong = near_light<LightDisk>("wrong", of(0.5), {0, 0, 2}, 0.3f);
    const LightDisk met(of(0.5), kOrigin), weighed(of(0.525), kOrigin);
    wrong.pdf = [&](const glm::vec3 &d) {
        const auto distance = met.crossing(kOrigin, d);
        return distance ? weighed.pdf(kOrigin, d, *distance) : 0.0f;
    };
    EXPECT_GT(std::abs(density_in_all(wrong) - 1), 0.05);
}

// Samples over their density give the same moments of directions as all directions one by one, and
// what is sampled is met with the same density.
TEST(LightKinds, SamplesHaveTheirDensity) {
    for (const Sampled &light : sampled_lights()) {
        constexpr int kGrid = 200;
        std::array<double, 4> sampled{};
        int met = 0;
        for (int i = 0; i < kGrid; ++i)
            for (int j = 0; j < kGrid; ++j) {
                const auto ray =
                    light.sample({(float(i) + 0.5f) / kGrid, (float(j) + 0.5f) / kGrid});
                ASSERT_TRUE(ray) << light.name;
                const glm::vec3 d = ray->to_light;
                const double terms[] = {1, d.x, d.y, double(d.x) * d.y};
                for (std::size_t m = 0; m < 4; ++m)
                    sampled[m] += terms[m] / double(ray->pdf) / kGrid / kGrid;
                if (const float pdf = light.pdf(d); pdf > 0) {
                    ++met;
                    EXPECT_NEAR(pdf, ray->pdf, 2e-3 * ray->pdf) << light.name;
                }
            }
        EXPECT_GT(met, 0.98 * kGrid * kGrid) << light.name;
        for (std::size_t m = 0; m < 4; ++m) {
            const double exact = over_directions(light, [&](const glm::vec3 &d) {
                const double terms[] = {1, d.x, d.y, double(d.x) * d.y};
                return light.pdf(d) > 0 ? terms[m] : 0.0;
            });
            const double angle =
                over_directions(light, [&](const glm::vec3 &d) { return light.pdf(d) > 0; });
            EXPECT_NEAR(sampled[m], exact, 6e-3 * angle) << light.name << ", moment " << m;
        }
    }
}

// The formulas of light.h against the sampled rays.
TEST(LightKinds, IrradianceIsThatOfTheSamples) {
    for (const Sampled &light : sampled_lights()) {
        constexpr int kGrid = 300;
        double sum = 0;
        for (int i = 0; i < kGrid; ++i)
            for (int j = 0; j < kGrid; ++j)
                if (const auto ray =
                        light.sample({(float(i) + 0.5f) / kGrid, (float(j) + 0.5f) / kGrid}))
                    sum += double(ray->radiance / ray->pdf) *
                           std::max(0.0f, glm::dot(ray->to_light, light.towards)) / kGrid / kGrid;
        EXPECT_NEAR(irradiance(light.light, kOrigin, light.towards), sum, 2e-3 * sum) << light.name;
    }
}

// What a light sends through a large sphere around it.
TEST(LightKinds, FluxIsTheSumOverAllSides) {
    const std::vector<Light> lights{
        RectangleLight{.corner = {-0.01, -0.01, 0}, .edge_u = {0.02, 0, 0}, .edge_v = {0, 0.02, 0}},
        DiskLight{.centre = kOrigin, .radius = 0.005, .radiance = 2},
        SphereLight{.centre = kOrigin, .radius = 0.02},
        PointLight{.position = kOrigin, .intensity = 3},
        PointLight{.position = kOrigin, .full_angle = 0.3, .cone_angle = 0.9},
        PointLight{
            .position = kOrigin, .direction = {1, 1, 1}, .full_angle = 0.5, .cone_angle = 0.5}};
    for (const Light &light : lights) {
        constexpr int kSteps = 400;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double c = 1 - 2 * (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps;
                const double s = std::sqrt(1 - c * c);
                const glm::dvec3 d(s * std::cos(phi), s * std::sin(phi), c);
                const bool one_sided = std::holds_alternative<RectangleLight>(light) ||
                                       std::holds_alternative<DiskLight>(light);
                const bool dark = std::holds_alternative<RectangleLight>(light) ? c < 0 : c > 0;
                if (!(one_sided && dark))
                    sum += irradiance(light, 10.0 * d, -d) * 100 * 4 * kPi / kSteps / kSteps;
            }
        EXPECT_NEAR(flux(light), sum, 5e-3 * sum) << light.index();
    }
}

TEST(LightSun, IsParallelWhereItIsSmall) {
    const LightSun parallel({.to_light = {0, 2, 0}, .angular_radius = 0, .irradiance = 4});
    EXPECT_EQ(parallel.sample({0.3f, 0.9f}).to_light, glm::vec3(0, 1, 0));
    EXPECT_EQ(parallel.sample({0.3f, 0.9f}).pdf, kOnlyDirection);
    EXPECT_EQ(parallel.sample({0.3f, 0.9f}).radiance, 4);
    EXPECT_FALSE(parallel.is_met({0, 1, 0}));
    EXPECT_TRUE(LightSun({.to_light = {0, 2, 0}}).is_met({0, 1, 0}));
}

// Bounds of lights of every kind, and where one gives light.
struct Bounded {
    LightBounds bounds;
    std::function<std::optional<LightRay>(const glm::vec3 &, glm::vec2)> sample;
};

template <class Traced> Bounded bounded(const Traced &light) {
    return {light.bounds(static_cast<float>(light.highest_intensity())),
            [light](const glm::vec3 &from, glm::vec2 u) { return light.sample(from, u); }};
}

std::vector<Bounded> lights_of_all_kinds(std::size_t count, std::mt19937 &random) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    std::vector<Bounded> lights;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3 at = 3.0 * vector(), along = vector();
        const double size = 0.1 + 0.2 * std::abs(normal(random));
        if (i % 5 == 0)
            lights.push_back(bounded(LightRectangle(
                {.corner = at, .edge_u = size * along, .edge_v = size * vector()}, kOrigin)));
        else if (i % 5 == 1)
            lights.push_back(
                bounded(LightDisk({.centre = at, .direction = along, .radius = size}, kOrigin)));
        else if (i % 5 == 2)
            lights.push_back(bounded(LightSphere({.centre = at, .radius = size}, kOrigin)));
        else if (i % 5 == 3)
            lights.push_back(bounded(LightPoint({.position = at}, kOrigin)));
        else
            lights.push_back(bounded(LightPoint({.position = at,
                                                 .direction = along,
                                                 .full_angle = size,
                                                 .cone_angle = size + 0.3 * double(i % 3)},
                                                kOrigin)));
    }
    return lights;
}

TEST(LightTree, ForgetsNoLightOfAnyKind) {
    std::mt19937 random(15);
    const std::vector<Bounded> lights = lights_of_all_kinds(10000, random);
    std::vector<LightBounds> bounds;
    for (const Bounded &light : lights)
        bounds.push_back(light.bounds);
    const LightTree tree(bounds);
    std::normal_distribution<float> normal;
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    std::array<int, 5> lit{};
    for (int trial = 0; trial < 10; ++trial) {
        const Receiver receiver{2.0f * vector(), glm::normalize(vector()), trial % 2 == 0};
        double sum = 0;
        for (std::size_t i = 0; i < lights.size(); ++i) {
            const float probability = tree.probability(receiver, i);
            sum += double(probability);
            for (const glm::vec2 u : {glm::vec2(0), {0.99f, 0}, {0.99f, 0.25f}, {0.99f, 0.6f}}) {
                const auto ray = lights[i].sample(receiver.position, u);
                const bool gives =
                    ray && ray->radiance > 0 &&
                    (receiver.both_sides || glm::dot(ray->to_light, receiver.normal) > 1e-3f);
                lit[i % 5] += gives ? 1 : 0;
                if (gives) {
                    ASSERT_GT(probability, 0) << i;
                }
            }
        }
        EXPECT_LT(sum, 1.001); // what is lost are branches where nothing gives
    }
    for (const int count : lit)
        EXPECT_GT(count, 1000);
}

// Spots that point away are not chosen.
TEST(LightTree, KnowsTheConesOfSpots) {
    const LightPoint spot({.position = {0, 2, 0}, .full_angle = 0.3, .cone_angle = 0.4}, kOrigin);
    const LightBounds bounds = spot.bounds(1);
    EXPECT_GT(bounds.importance({{0.8f, 0, 0}, {0, 1, 0}, false}), 0);
    EXPECT_EQ(bounds.importance({{0.9f, 0, 0}, {0, 1, 0}, false}), 0);
}

} // namespace
} // namespace tsuya::test

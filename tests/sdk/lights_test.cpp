// How rectangles are sampled, and how one of many lights is chosen.

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "light_rectangle.h"
#include "light_tree.h"

namespace tsuya::test {
namespace {

struct Place {
    const char *name;
    glm::dvec3 edge_u, edge_v, from; // the corner is at 0, the light shines to +z
    bool by_angle;
};

const Place kPlaces[] = {
    {"softbox", {1.2, 0, 0}, {0, 1.8, 0}, {0.4, 1.1, 2.6}, true},
    {"near strip", {0.35, 0, 0}, {0, 2.2, 0}, {3, 1, 0.6}, true},
    {"beside", {2, 0, 0}, {0, 3, 0}, {-1, -2, 1}, true},
    {"wide", {20, 0, 0}, {0, 20, 0}, {9, 12, 0.1}, true},
    {"far", {0.1, 0, 0}, {0, 0.1, 0}, {0.3, 0.2, 5}, false},
    {"grazing", {1, 0, 0}, {0, 1, 0}, {-0.3, 0.5, 0.01}, true},
    {"skewed", {1, 0, 0}, {0.8, 0.9, 0}, {0.2, 0.4, 0.7}, false},
    {"turned", {0, 1.5, 1.5}, {-1, 0, 0}, {-0.5, -1, 1.5}, true},
};

// Moments of directions over the solid angle of the light: by samples over their density, and by a
// fine grid.
using Moments = std::array<double, 5>;
void add(Moments &m, const glm::dvec3 &d, double weight) {
    const double terms[] = {1, d.x, d.y, d.x * d.x, d.x * d.y};
    for (std::size_t i = 0; i < m.size(); ++i)
        m[i] += terms[i] * weight;
}

TEST(LightRectangle, SamplesHaveTheirDensity) {
    for (const Place &p : kPlaces) {
        const LightRectangle light(
            {.corner = {0, 0, 0}, .edge_u = p.edge_u, .edge_v = p.edge_v, .radiance = 2},
            {0, 0, 0});
        const glm::dvec3 across = glm::cross(p.edge_u, p.edge_v);
        constexpr int kGrid = 1000;
        Moments exact{}, sampled{};
        float least = 1e30f, most = 0;
        for (int j = 0; j < kGrid; ++j)
            for (int i = 0; i < kGrid; ++i) {
                const double u = (i + 0.5) / kGrid, v = (j + 0.5) / kGrid;
                const glm::dvec3 offset = u * p.edge_u + v * p.edge_v - p.from;
                const double distance = glm::length(offset);
                add(exact, offset / distance,
                    -glm::dot(offset, across) / std::pow(distance, 3) / kGrid / kGrid);
                if (i % 5 != 2 || j % 5 != 2)
                    continue;
                const auto ray = light.sample(p.from, {float(u), float(v)});
                ASSERT_TRUE(ray) << p.name;
                add(sampled, ray->to_light, 25 / double(ray->pdf) / kGrid / kGrid);
                const auto distance_met = light.crossing(p.from, ray->to_light);
                if (distance_met) {
                    EXPECT_NEAR(*distance_met, ray->distance, 2e-4 * ray->distance) << p.name;
                    EXPECT_NEAR(light.pdf(p.from, ray->to_light, *distance_met), ray->pdf,
                                2e-3 * ray->pdf)
                        << p.name;
                }
                least = std::min(least, ray->pdf);
                most = std::max(most, ray->pdf);
            }
        for (std::size_t i = 0; i < exact.size(); ++i)
            EXPECT_NEAR(sampled[i], exact[i], 4e-3 * exact[0]) << p.name << ", moment " << i;
        EXPECT_EQ(least == most, p.by_angle) << p.name;
        EXPECT_FALSE(light.sample(p.from - 100.0 * glm::normalize(across), {0.5, 0.5})) << p.name;
    }
}

std::vector<LightRectangle> random_lights(std::size_t count, std::mt19937 &random) {
    std::normal_distribution<double> normal;
    const auto vector = [&] { return glm::dvec3(normal(random), normal(random), normal(random)); };
    std::vector<LightRectangle> lights;
    for (std::size_t i = 0; i < count; ++i)
        lights.emplace_back(RectangleLight{.corner = 3.0 * vector(),
                                           .edge_u = 0.3 * vector(),
                                           .edge_v = 0.3 * vector(),
                                           .radiance = std::exp(normal(random))},
                            glm::dvec3(0));
    return lights;
}

Receiver random_receiver(std::mt19937 &random) {
    std::normal_distribution<float> normal;
    const auto vector = [&] { return glm::vec3(normal(random), normal(random), normal(random)); };
    return {2.0f * vector(), glm::normalize(vector()), random() % 2 == 0};
}

LightTree tree_of(const std::vector<LightRectangle> &lights) {
    std::vector<LightBounds> bounds;
    for (const LightRectangle &light : lights)
        bounds.push_back(light.bounds(static_cast<float>(light.highest_intensity())));
    return LightTree(std::move(bounds));
}

TEST(LightTree, ChoosesWithItsProbabilities) {
    std::mt19937 random(4);
    for (const std::size_t count : {1u, 2u, 3u, 17u, 64u}) {
        const std::vector<LightRectangle> lights = random_lights(count, random);
        const LightTree tree = tree_of(lights);
        for (int trial = 0; trial < 20; ++trial) {
            const Receiver receiver = random_receiver(random);
            std::vector<double> chosen(count);
            constexpr int kChoices = 4000;
            for (int i = 0; i < kChoices; ++i)
                if (const auto c = tree.choose(receiver, (float(i) + 0.5f) / kChoices)) {
                    chosen[c->light] += 1.0 / kChoices;
                    EXPECT_NEAR(c->probability, tree.probability(receiver, c->light),
                                1e-5 * c->probability);
                }
            for (std::size_t i = 0; i < count; ++i)
                EXPECT_NEAR(chosen[i], tree.probability(receiver, i), 2.0 / kChoices);
        }
    }
}

// A light that gives something can be chosen.
TEST(LightTree, ForgetsNoLight) {
    std::mt19937 random(5);
    const std::vector<LightRectangle> lights = random_lights(100, random);
    const LightTree tree = tree_of(lights);
    int lit = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const Receiver receiver = random_receiver(random);
        for (std::size_t i = 0; i < lights.size(); ++i)
            for (const glm::vec2 u : {glm::vec2(0), {1, 0}, {0, 1}, {1, 1}, {0.5, 0.5}}) {
                const auto ray = lights[i].sample(receiver.position, u);
                const bool gives = ray && (receiver.both_sides ||
                                           glm::dot(ray->to_light, receiver.normal) > 1e-3f);
                lit += gives ? 1 : 0;
                if (gives && ray->radiance > 0) {
                    ASSERT_GT(tree.probability(receiver, i), 0) << i;
                }
            }
    }
    EXPECT_GT(lit, 1000);
}

TEST(LightTree, MeetsTheLightsThatARayCrosses) {
    std::mt19937 random(6);
    const std::vector<LightRectangle> lights = random_lights(300, random);
    const LightTree tree = tree_of(lights);
    int crossings = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        Receiver ray = random_receiver(random);
        if (trial % 3 == 0)
            ray.normal[trial / 3 % 3] = 0;
        std::vector<bool> one_by_one(lights.size()), by_tree(lights.size());
        for (std::size_t i = 0; i < lights.size(); ++i)
            one_by_one[i] = lights[i].crossing(ray.position, ray.normal).has_value();
        tree.cross(ray.position, ray.normal, [&](std::size_t i) {
            by_tree[i] = lights[i].crossing(ray.position, ray.normal).has_value();
            crossings += by_tree[i] ? 1 : 0;
            return false;
        });
        EXPECT_EQ(by_tree, one_by_one);
    }
    EXPECT_GT(crossings, 300);
}

} // namespace
} // namespace tsuya::test

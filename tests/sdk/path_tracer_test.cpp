// The path tracer's samples, one by one: their mean against a walk that knows nothing of densities,
// and their largest values.

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include "path_tracer.h"
#include "sdk/render_scenes.h"
#include "tsuya/sdk/prepared_scene.h"
#include "vertex.h"

namespace tsuya::test {
namespace {

constexpr int kSize = 16; // pixels
constexpr int kBounces = 2;

// The folds in white satin between two large lamps and an even environment.
Scene lit_folds() {
    Scene scene = folded_satin(kSize, kSize);
    scene.fabrics[0] = satin(0.9);
    scene.lights = {
        RectangleLight{
            .corner = {-3, 0, 1}, .edge_u = {2, 0, 1.5}, .edge_v = {0, 2, 0}, .radiance = 6},
        RectangleLight{.corner = {1.2, 0.3, 1.6},
                       .edge_u = {1, 0, -1.2},
                       .edge_v = {0, 1.5, 0},
                       .radiance = 9}};
    for (Light &each : scene.lights) { // towards the folds
        auto &light = std::get<RectangleLight>(each);
        if (glm::dot(glm::cross(light.edge_u, light.edge_v), glm::dvec3(0, 1, 0) - light.corner) <
            0)
            std::swap(light.edge_u, light.edge_v);
    }
    return scene;
}

struct Traced {
    Scene scene;
    RenderSettings settings;
    PreparedScene kept{};
    TracedScene traced;

    Traced(Scene made, bool widen, int bounces = kBounces)
        : scene(std::move(made)), settings{.channels = 8,
                                           .max_bounces = bounces,
                                           .widen_after_diffuse = widen},
          traced(scene, plan(scene, settings), {.count = 8}, kept, false, {}) {}
};

// Of all groups, the first channel, of the samples of one pixel and seed.
std::vector<float> samples_of(PathTracer<8> &tracer, std::size_t groups, int x, int y,
                              std::uint32_t seed, std::uint32_t count) {
    std::vector<Sampler> samplers;
    for (std::uint32_t s = 0; s < count; ++s)
        samplers.emplace_back(hash(hash(std::uint32_t(x), std::uint32_t(y)), seed), s);
    std::vector<Channels<8>> radiance(count * groups);
    tracer.trace(x, y, samplers, radiance.data(), groups, nullptr, {});
    std::vector<float> values(count);
    for (std::size_t i = 0; i < radiance.size(); ++i)
        values[i / groups] += radiance[i].v[0];
    return values;
}

constexpr float kFar = std::numeric_limits<float>::infinity();

// Of lights nearer than a distance.
float light_met(const TracedScene &scene, const glm::vec3 &from, const glm::vec3 &direction,
                float distance) {
    float sum = 0;
    scene.lights.meet(from, direction, distance, [&](const LightMet &met) { sum += met.radiance; });
    return sum;
}

// A walk whose directions are even over the sphere; lights are met, never sampled.
float walk(const TracedScene &scene, const CameraRay &ray, int bounces, std::mt19937 &random) {
    std::uniform_real_distribution<float> even(0, 1);
    glm::vec3 origin = ray.origin, direction = ray.direction;
    Hit hit;
    if (!scene.accelerator.intersect(origin, direction, kFar, hit))
        return light_met(scene, origin, direction, kFar);
    float sum = 0, throughput = 1;
    for (int bounce = 0;; ++bounce) {
        const SurfacePoint point = scene.point(direction, hit);
        const Vertex vertex(scene, point, direction, false);
        const float z = 2 * even(random) - 1, turn = 2 * kPiF * even(random);
        const float across = std::sqrt(1 - z * z);
        direction = {across * std::cos(turn), across * std::sin(turn), z};
        const Response f_cos = vertex.weigh(direction).f_cos;
        const Colours &c = scene.colours[point.colours];
        throughput *= 4 * kPiF *
                      (c.dye[0] * f_cos.diffuse + c.weft[0] * f_cos.weft + c.warp[0] * f_cos.warp +
                       c.weft_body[0] * f_cos.weft_body + c.warp_body[0] * f_cos.warp_body);
        if (!(throughput > 0))
            return sum;
        origin = vertex.ray_origin(direction);
        const bool found = scene.accelerator.intersect(origin, direction, kFar, hit);
        sum += throughput * light_met(scene, origin, direction, found ? hit.distance : kFar);
        if (!found)
            return sum;
        if (bounce == bounces)
            return sum;
    }
}

struct Mean {
    double value = 0, error = 0; // standard

    explicit Mean(const std::vector<double> &values) {
        const double n = double(values.size());
        value = std::accumulate(values.begin(), values.end(), 0.0) / n;
        for (const double v : values)
            error += (v - value) * (v - value);
        error = std::sqrt(error / (n * (n - 1)));
    }
};

// The mean of the picture by 64 parts of the walks.
Mean mean_of_walks(const TracedScene &scene, int bounces) {
    std::vector<double> parts;
    for (std::uint32_t part = 0; part < 64; ++part) {
        std::mt19937 random(part);
        std::uniform_real_distribution<float> place(0, kSize);
        constexpr int kWalks = 1 << 14;
        double sum = 0;
        for (int i = 0; i < kWalks; ++i)
            sum += double(walk(scene,
                               scene.camera.through(place(random), place(random), Sampler(0, 0)),
                               bounces, random));
        parts.push_back(sum / kWalks);
    }
    return Mean(parts);
}

TEST(PathTracer, SixtyFourSeedsHaveTheMeanOfAWalkThatKnowsNoDensities) {
    const Traced p(lit_folds(), false);
    std::vector<double> seeds;
    for (std::uint32_t seed = 0; seed < 64; ++seed) {
        PathTracer<8> tracer(p.traced);
        double sum = 0;
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                for (const float v : samples_of(tracer, p.scene.light_groups.size(), x, y, seed, 4))
                    sum += double(v);
        seeds.push_back(sum / (4 * kSize * kSize));
    }
    const Mean traced(seeds), walked = mean_of_walks(p.traced, kBounces);
    std::cout << "traced " << traced.value << " +- " << traced.error << ", walked " << walked.value
              << " +- " << walked.error << "\n";
    EXPECT_LT(traced.error, 0.002 * traced.value);
    EXPECT_LT(std::abs(traced.value - walked.value), 4 * std::hypot(traced.error, walked.error));
    // Negative control: walks without their last bounce
    const Mean shorter = mean_of_walks(p.traced, kBounces - 1);
    EXPECT_GT(std::abs(traced.value - shorter.value), 6 * std::hypot(traced.error, shorter.error));
}

// Of all samples, the share whose light from bounces is above 50 times the mean of the pixel. What
// the camera sees directly may be so bright in a small part of a pixel.
double share_far_above_mean(const Specular &sheet, bool widen) {
    constexpr std::uint32_t kSamples = 2048;
    Scene scene = lit_folds();
    scene.fabrics[0].specular = sheet;
    for (Light &each : scene.lights) { // small and bright
        auto &light = std::get<RectangleLight>(each);
        light.corner += 0.35 * (light.edge_u + light.edge_v);
        light.edge_u *= 0.3;
        light.edge_v *= 0.3;
        light.radiance *= 11;
    }
    const std::size_t groups = scene.light_groups.size();
    const Traced whole(scene, widen), direct(scene, widen, 0);
    PathTracer<8> tracer(whole.traced), direct_tracer(direct.traced);
    std::uint64_t above = 0;
    for (int y = 0; y < kSize; ++y)
        for (int x = 0; x < kSize; ++x) {
            const std::vector<float> values = samples_of(tracer, groups, x, y, 0, kSamples);
            const std::vector<float> seen = samples_of(direct_tracer, groups, x, y, 0, kSamples);
            const double mean = std::accumulate(values.begin(), values.end(), 0.0) / kSamples;
            for (std::size_t i = 0; i < kSamples; ++i)
                above += double(values[i]) - double(seen[i]) > 50 * mean ? 1 : 0;
        }
    return double(above) / (double(kSamples) * kSize * kSize);
}

TEST(PathTracer, WiderLobesMakeSamplesFarAboveTheirPixelSeldom) {
    const Specular facets = GgxFacets{.alpha_weft = 0.03, .alpha_warp = 0.03, .f0 = 0.3};
    const double before = share_far_above_mean(facets, false);
    const double after = share_far_above_mean(facets, true);
    std::cout << "above 50 times the mean: " << before << ", with wider lobes " << after << "\n";
    EXPECT_GT(before, 2e-5);
    EXPECT_LT(after, before / 3); // paths that the facets mirror twice stay
}

TEST(PathTracer, NoSampleOfSatinIsFarAboveItsPixel) {
    const Specular satin = lit_folds().fabrics[0].specular;
    for (const bool widen : {false, true})
        EXPECT_EQ(share_far_above_mean(satin, widen), 0) << widen;
}

} // namespace
} // namespace tsuya::test

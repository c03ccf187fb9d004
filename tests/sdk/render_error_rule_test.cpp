// What --error promises: how a render stops by its error, and what it says of it.

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// How strong the lights are is a matter of exposure: the same samples, wherever they are dim.
TEST(Promises, ErrorRuleDoesNotDependOnTheStrengthOfTheLights) {
    Scene scene = folded_satin(32, 32);
    RenderSettings settings = quick(512);
    settings.stop.relative_error = 0.02;
    const RenderResult bright = render(scene, settings);
    constexpr float kDim = 1.0f / 128;
    for (Light &light : scene.lights)
        emission_of(light) *= kDim;
    if (scene.environment)
        scene.environment->radiance *= kDim;
    const RenderResult dim = render(scene, settings);
    EXPECT_EQ(dim.stats.samples_per_pixel, bright.stats.samples_per_pixel);
    EXPECT_EQ(dim.stats.relative_error, bright.stats.relative_error);
    EXPECT_GT(bright.stats.samples_per_pixel, 16);

    // What was not reached is told
    settings.stop.samples_per_pixel = 16;
    const std::vector<Problem> warnings = render(scene, settings).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].what.find("did not reach the error of 0.02"), std::string::npos)
        << warnings[0].what;
}

// An error rule spends samples where they are needed, and what it promises is there: the difference
// from a picture with many more samples.
TEST(Promises, ErrorRuleStopsEarly) {
    const Scene scene = folded_satin(64, 64);
    RenderSettings settings = quick(4096);
    settings.stop.relative_error = 0.03;
    double told = 0;
    const RenderResult result =
        render(scene, settings,
               {.report = [&](std::string_view, double done) { told = std::max(told, done); }});
    EXPECT_GT(told, 0.4); // by the tiles that are done, not by 4096 samples
    EXPECT_LT(result.stats.samples_per_pixel, 1000);
    EXPECT_GT(result.stats.samples_per_pixel, 16);
    EXPECT_LE(result.stats.relative_error, 0.03);
    EXPECT_EQ(result.stats.error_asked, 0.03);
    EXPECT_EQ(result.stats.error_reached_share, 1);
    const double whole = result.stats.samples_per_pixel;
    settings.stop.samples_per_pixel = 24;
    const RenderStats cut = render(scene, settings).stats;
    EXPECT_GT(cut.error_reached_share, 0);
    EXPECT_LT(cut.error_reached_share, 1);
    EXPECT_LT(cut.samples_per_pixel, whole);
    settings.stop.samples_per_pixel = 4096;

    settings.threads = 3;
    EXPECT_EQ(render(scene, settings).image.transport, result.image.transport);
}

// The mean absolute difference from a long reference over the mean value, all groups and these
// channels of a pixel together.
double true_error(const SpectralImage &image, const SpectralImage &reference, int first, int last) {
    double differences = 0, total = 0;
    const auto sum_of = [&](const SpectralImage &of, int x, int y) {
        double sum = 0;
        for (std::size_t g = 0; g < of.groups.size(); ++g)
            for (int k = first; k <= last; ++k)
                sum += of.pixel(g, x, y)[k];
        return sum;
    };
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            differences += std::abs(sum_of(image, x, y) - sum_of(reference, x, y));
            total += sum_of(reference, x, y);
        }
    return differences / total;
}

// Where the dye is chosen in the finished picture, the error is that of a dark dye as well: here it
// shows the surface of the fibres alone, which has more noise than the coloured part.
TEST(Promises, ErrorRuleHoldsForTheDarkestDye) {
    constexpr double kAsked = 0.04;
    Scene one = folded_satin(32, 32);
    one.lights.clear();
    one.light_groups = {"sky"};
    one.environment->group = {0};
    one.objects.pop_back(); // the floor, which is of no dye
    one.open_dyes = {FabricIndex{0}};
    Scene two = one; // colours, whose depths are in another order
    two.fabrics[0].colours.specular_tint = {{549, 551}, {0.9, 1}};
    for (const Scene *scene : {&one, &two}) {
        RenderSettings settings = quick(4096);
        settings.max_bounces = 0;
        settings.alpha = true; // the sky is no part of the picture
        settings.stop.relative_error = kAsked;
        const RenderResult result = render(*scene, settings);
        settings.stop = {.samples_per_pixel = 2048};
        settings.seed = 7;
        const SpectralImage reference = render(*scene, settings).image;
        const auto depth = [&](std::size_t k) {
            const auto &node = result.image.depths->node[k];
            return std::accumulate(node.begin(), node.end(), 0.0);
        };
        std::vector<int> channels(static_cast<std::size_t>(result.image.basis.count));
        std::iota(channels.begin(), channels.end(), 0);
        const int darkest = *std::min_element(channels.begin(), channels.end(), [&](int a, int b) {
            return depth(static_cast<std::size_t>(a)) < depth(static_cast<std::size_t>(b));
        });
        const double error = true_error(result.image, reference, darkest, darkest);
        EXPECT_NEAR(result.stats.relative_error, error, 0.15 * kAsked) << darkest;
        EXPECT_LT(error, 1.1 * kAsked) << darkest;
        EXPECT_GT(error, 0.5 * kAsked) << darkest;
        // By the mean of the depths it would have been done before
        EXPECT_GT(error, 1.4 * true_error(result.image, reference, 0, channels.back())) << darkest;
    }
}

TEST(Promises, TheErrorIsAsItIsTold) {
    Scene direct = folded_satin(40, 40), smooth = direct;
    direct.environment.reset();
    smooth.fabrics[0] = lambert(0.7);
    for (const Scene *scene : {&direct, &smooth})
        for (const int bounces : {0, 4}) {
            RenderSettings settings = quick(1024);
            settings.max_bounces = bounces;
            settings.seed = 5;
            const SpectralImage reference = render(*scene, settings).image;
            settings.seed = 1;
            for (const int samples : {7, 16, 64}) {
                // Never reached, but told by every pixel
                settings.stop = {.samples_per_pixel = samples, .relative_error = 1e-6};
                const RenderResult result = render(*scene, settings);
                const double error = true_error(result.image, reference, 0, 7);
                EXPECT_LT(result.stats.relative_error, 1.15 * error) << bounces << " " << samples;
                EXPECT_GT(result.stats.relative_error, error / 1.15) << bounces << " " << samples;
                // By a quarter of them, with a margin above
                settings.stop.relative_error.reset();
                const RenderResult plain = render(*scene, settings);
                const double less = true_error(plain.image, reference, 0, 7);
                EXPECT_LT(less, 1.2 * error) << bounces << " " << samples;
                EXPECT_LT(plain.stats.relative_error, 1.8 * less) << bounces << " " << samples;
                EXPECT_GT(plain.stats.relative_error, less / 1.4) << bounces << " " << samples;
            }
        }
}

} // namespace

// Wider lobes after diffuse scattering: what they change, what they tell, and what stays.

#include <array>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <variant>

#include <gtest/gtest.h>
#include <unistd.h>

#include "sdk/render_scenes.h"
#include "tsuya/sdk/kept_materials.h"
#include "tsuya/sdk/widened_material.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A folded mirror throws caustics onto the floor, which paths find seldom.
Scene folded_mirror(int size) {
    Scene scene = folded_satin(size, size);
    scene.fabrics[0].specular = GgxFacets{.alpha_weft = 0.02, .alpha_warp = 0.02, .f0 = 0.5};
    return scene;
}

// So that it fills the picture.
void look_at_floor(Scene &scene) {
    scene.camera.target = {0.3, 0, 0.8};
    scene.camera.eye = {0.3, 1.6, 2.4};
}

RenderSettings widening(int samples) {
    RenderSettings settings = quick(samples);
    settings.widen_after_diffuse = true;
    return settings;
}

double sum_of(const SpectralImage &image) {
    return std::accumulate(image.transport.begin(), image.transport.end(), 0.0);
}

TEST(Widening, LeavesWhatIsSeenDirectly) {
    const Scene scene = folded_mirror(24);
    RenderSettings plain = quick(8), wide = widening(8);
    plain.max_bounces = wide.max_bounces = 0;
    const RenderResult result = render(scene, wide);
    EXPECT_EQ(result.image.transport, render(scene, plain).image.transport);
    EXPECT_FALSE(result.stats.widening_change);
}

TEST(Widening, LeavesWhatHasNoLobes) {
    Scene scene = folded_mirror(24);
    scene.fabrics[0] = lambert(0.4);
    const RenderResult result = render(scene, widening(8));
    EXPECT_EQ(result.image.transport, render(scene, quick(8)).image.transport);
    ASSERT_TRUE(result.stats.widening_change);
    EXPECT_NEAR(*result.stats.widening_change, 0, 1e-6);
    EXPECT_EQ(result.image.metadata.count("widening_change"), 1u);
}

TEST(Widening, IsOffUnlessAskedFor) {
    const Scene scene = folded_mirror(24);
    const RenderResult result = render(scene, quick(8));
    EXPECT_FALSE(result.stats.widening_change);
    EXPECT_EQ(result.image.metadata.count("widening_change"), 0u);
    EXPECT_NE(result.image.transport, render(scene, widening(8)).image.transport);
}

// Mean and standard error.
std::array<double, 2> mean_of(const std::vector<double> &values) {
    const double n = double(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
    double square = 0;
    for (const double v : values)
        square += (v - mean) * (v - mean);
    return {mean, std::sqrt(square / (n * (n - 1)))};
}

// What it tells is what it does: the difference of renders with it and without it.
TEST(Widening, TellsByHowMuchItChangesTheMean) {
    Scene scene = folded_mirror(32);
    scene.fabrics[0].specular = GgxFacets{.alpha_weft = 0.15, .alpha_warp = 0.15, .f0 = 1};
    scene.environment.reset();
    std::get<RectangleLight>(scene.lights[0]).corner.y += 1.5;
    look_at_floor(scene);
    std::vector<double> told, done;
    for (std::uint32_t seed = 0; seed < 12; ++seed) {
        RenderSettings plain = quick(64), wide = widening(64);
        plain.seed = wide.seed = seed;
        const RenderResult result = render(scene, wide);
        told.push_back(result.stats.widening_change.value());
        done.push_back(sum_of(result.image) / sum_of(render(scene, plain).image) - 1);
    }
    const auto [told_mean, told_error] = mean_of(told);
    const auto [done_mean, done_error] = mean_of(done);
    std::cout << "told " << told_mean << " +- " << told_error << ", done " << done_mean << " +- "
              << done_error << "\n";
    EXPECT_NEAR(told_mean, done_mean, 4 * std::hypot(told_error, done_error));
    // Nothing told, and the opposite, would not pass
    EXPECT_GT(std::abs(done_mean), 6 * std::hypot(told_error, done_error));
}

// Values above three times the median of the 5 x 5 around them.
int specks(const SpectralImage &image) {
    int count = 0;
    for (int y = 2; y < image.height - 2; ++y)
        for (int x = 2; x < image.width - 2; ++x) {
            std::array<float, 25> around{};
            for (int i = 0; i < 25; ++i)
                around[std::size_t(i)] = *image.pixel(0, x + i % 5 - 2, y + i / 5 - 2);
            const float here = around[12];
            std::nth_element(around.begin(), around.begin() + 12, around.end());
            count += here > 3 * around[12] ? 1 : 0;
        }
    return count;
}

TEST(Widening, TakesSpecksAway) {
    Scene scene = folded_mirror(64);
    look_at_floor(scene);
    const int before = specks(render(scene, quick(16)).image);
    const int after = specks(render(scene, widening(16)).image);
    std::cout << before << " specks, " << after << " with wider lobes\n";
    EXPECT_GE(before, 30);
    EXPECT_LE(after, before / 6);
}

TEST(Widening, IsTheSameForAnyThreadsAfterAStopAndWithoutSkips) {
    const Scene scene = folded_mirror(50);
    RenderSettings settings = widening(24);
    settings.threads = 1;
    const RenderResult whole = render(scene, settings);
    const auto expect_same = [&](const char *how) {
        const RenderResult other = render(scene, settings);
        EXPECT_EQ(other.image.transport, whole.image.transport) << how;
        EXPECT_EQ(other.stats.widening_change, whole.stats.widening_change) << how;
    };
    settings.skip = false;
    expect_same("without skips");
    settings.skip = true;
    settings.threads = 3;
    expect_same("three threads");

    settings.checkpoint = std::filesystem::path(testing::TempDir()) /
                          ("tsuya-widening-" + std::to_string(getpid()) + ".checkpoint");
    std::atomic<bool> stop{false};
    const Progress halfway{.report = [&](std::string_view stage,
                                         double done) { stop = stage == "render" && done > 0.4; },
                           .stop = &stop};
    ASSERT_TRUE(render(scene, settings, halfway).stats.interrupted);
    settings.resume = true;
    expect_same("after a stop");
    std::filesystem::remove(settings.checkpoint);
}

glm::vec3 direction(double theta_deg, double phi_deg) {
    const double theta = theta_deg * kDegree, phi = phi_deg * kDegree;
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

TEST(WidenedMaterial, BodyIsWiderAndReflectsAsMuch) {
    const Material material = resolve(satin(0.6), "satin");
    const std::optional<Material> wide = widened(material);
    ASSERT_TRUE(wide && wide->body);
    for (const double theta : {5.0, 30.0, 60.0, 80.0})
        for (const double phi : {0.0, 40.0, 90.0}) {
            const glm::vec3 d = direction(theta, phi);
            EXPECT_NEAR(wide->body->albedo(d), material.body->albedo(d), 0.01)
                << theta << " " << phi;
            EXPECT_EQ(wide->specular->albedo_of_view(d), material.specular->albedo_of_view(d));
        }
    const auto peak = [](const BodyBrdf &body) {
        float most = 0;
        for (double theta = -60; theta <= 60; theta += 1)
            most = std::max(most, body.evaluate(direction(theta, 90), direction(20, 90)));
        return most;
    };
    EXPECT_LT(peak(*wide->body), 0.8f * peak(*material.body));
}

TEST(WidenedMaterial, FacetsAreWiderAlongBothAxes) {
    Fabric fabric = lambert(0.2);
    fabric.specular = GgxFacets{.alpha_weft = 0.05, .alpha_warp = 0.6};
    Fabric as_widened = fabric;
    as_widened.specular = GgxFacets{.alpha_weft = 0.3, .alpha_warp = 0.6};
    const std::optional<Material> wide = widened(resolve(fabric, "facets"));
    ASSERT_TRUE(wide);
    const Material expected = resolve(as_widened, "facets");
    for (const double theta : {10.0, 50.0})
        for (const double phi : {0.0, 70.0})
            EXPECT_FLOAT_EQ(
                wide->specular->evaluate(direction(20, 180 + phi), direction(theta, phi)),
                expected.specular->evaluate(direction(20, 180 + phi), direction(theta, phi)));
    EXPECT_FALSE(widened(expected)) << "it is wide enough";
}

TEST(WidenedMaterial, NothingElseIsWidened) {
    EXPECT_FALSE(widened(resolve(lambert(0.5), "plain")));
    Fabric fabric = satin(0.4);
    fabric.specular =
        CarriedViews{.bard = satin_bard(), .model = ViewModel::half_vector, .f0 = 0.05};
    EXPECT_FALSE(widened(resolve(fabric, "views")));
}

// Another dye of the cloth takes the tables, in its own colours.
TEST(WidenedMaterial, IsKeptForOtherDyes) {
    KeptMaterials kept;
    for (const double dye : {0.6, 0.2}) {
        const Fabric fabric = satin(dye);
        const std::optional<Material> wide = kept.widened(fabric, kept.resolve(fabric, "satin"));
        const std::optional<Material> expected = widened(resolve(fabric, "satin"));
        ASSERT_TRUE(wide && expected);
        EXPECT_EQ(wide->warp_body, expected->warp_body);
        const glm::vec3 light = direction(30, 20), viewer = direction(40, 200);
        EXPECT_EQ(wide->body->evaluate(light, viewer), expected->body->evaluate(light, viewer));
    }
}

} // namespace

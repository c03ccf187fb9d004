// AOVs of a render: what the camera sees, parts of the light, and what a stop keeps of them.

#include <cmath>
#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

#include "sdk/aov_scenes.h"
#include "tsuya/sdk/plan.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// Transport of a pixel, per group and channel.
double sum_of(const Image &part, int x, int y) {
    const float *const p = part.pixel(x, y);
    return std::accumulate(p, p + part.channels.size(), 0.0);
}

TEST(Aov, PartsOfTheLightAddUp) {
    for (const Scene &scene : {folded_satin(24, 24), lace()}) {
        const SpectralImage image =
            rendered(scene, quick(16), {"direct", "surface", "indirect", "body"});
        const auto channels = static_cast<std::size_t>(image.basis.count);
        double part[4] = {}, whole = 0;
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
                for (std::size_t g = 0; g < 2; ++g)
                    for (std::size_t k = 0; k < channels; ++k) {
                        const float t = image.pixel(g, x, y)[k];
                        float v[4];
                        for (std::size_t i = 0; i < 4; ++i) {
                            v[i] = image.aovs[i].pixel(x, y)[g * channels + k];
                            part[i] += double(v[i]);
                        }
                        whole += double(t);
                        ASSERT_NEAR(v[0] + v[2], t, 2e-6f * std::max(1.0f, t));
                        ASSERT_NEAR(v[1] + v[3], t, 2e-6f * std::max(1.0f, t));
                    }
        for (const double p : part) // none is nothing, none is all
            EXPECT_TRUE(p > 0.02 * whole && p < 0.98 * whole) << p / whole;
        EXPECT_EQ(image.aovs[0].channels[8], "fill." + channel_names(image.basis, false)[0]);
    }
}

// Asking for AOVs changes nothing; not asking leaves them out.
TEST(Aov, ThePictureStaysTheSame) {
    for (const Scene &scene : {folded_satin(24, 24), lace()}) {
        const RenderSettings settings = quick(8);
        EXPECT_EQ(rendered(scene, settings, aov_names()).transport,
                  rendered(scene, settings, {}).transport);
    }
    const auto tells_parts = [](std::vector<std::string> aovs) {
        RenderSettings settings = quick(8);
        settings.aovs = std::move(aovs);
        return plan(folded_satin(8, 8), settings).feature("parts of the light").on;
    };
    EXPECT_FALSE(tells_parts({"depth"}));
    EXPECT_TRUE(tells_parts({"body"}));
}

TEST(Aov, DirectIsWhatARenderWithoutBouncesHas) {
    const Scene scene = folded_satin(24, 24);
    RenderSettings settings = quick(16);
    const Image direct = aov_of(rendered(scene, settings, {"direct"}), "direct");
    settings.max_bounces = 0;
    const SpectralImage alone = render(scene, settings).image;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x)
            for (std::size_t g = 0; g < 2; ++g)
                for (std::size_t k = 0; k < 8; ++k)
                    ASSERT_NEAR(direct.pixel(x, y)[g * 8 + k], alone.pixel(g, x, y)[k],
                                1e-5f * std::max(1.0f, alone.pixel(g, x, y)[k]));
}

TEST(Aov, SurfaceAndBodyAreWhatHasOnlyOneOfThem) {
    Scene scene = folded_satin(24, 24);
    scene.camera.target = {0, 1, 0};
    scene.objects.pop_back(); // no floor
    scene.surfaces.pop_back();
    scene.environment->visible = false;
    const auto sums = [&](double dye) {
        scene.fabrics = {satin(dye)};
        const SpectralImage image = rendered(scene, quick(64), {"surface", "body"});
        glm::dvec2 sum(0);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
                sum += glm::dvec2(sum_of(image.aovs[0], x, y), sum_of(image.aovs[1], x, y));
        return sum;
    };
    const glm::dvec2 black = sums(0), grey = sums(0.3);
    EXPECT_EQ(black.y, 0);
    EXPECT_GT(grey.y, 0.1 * grey.x);
    // The surface reflects what it did, and what more comes between the folds
    EXPECT_GT(grey.x, 0.98 * black.x);
    EXPECT_LT(grey.x, 1.2 * black.x);
    scene.fabrics = {lambert(0.5)};
    const SpectralImage plain = rendered(scene, quick(4), {"surface"});
    EXPECT_EQ(*std::max_element(plain.aovs[0].data.begin(), plain.aovs[0].data.end()), 0);
}

TEST(Aov, ShapeAndClothAreThoseOfTheSurface) {
    Scene scene = folded_satin(16, 16);
    scene.surfaces = {floor_square(6)};
    scene.surfaces[0].uv = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};
    scene.surfaces[0].weft.assign(4, {0.6f, 0, 0.8f}); // sheared
    scene.fabrics = {lambert(0.3)};
    scene.objects = {{.name = "floor", .surface = {0}, .fabric = {0}, .garment = true}};
    scene.camera = {.eye = {0.5, 3, 0.2},
                    .target = {0.5, 0, 0.2},
                    .up = {0, 0, -1},
                    .vertical_angle = 0.01,
                    .width = 16,
                    .height = 16};
    const SpectralImage image = rendered(
        scene, quick(8),
        {"coverage", "garment", "depth", "normal", "warp", "weft", "uv", "albedo", "samples"});
    const auto at = [&](const char *name) { return aov_of(image, name).pixel(8, 8); };
    EXPECT_EQ(*at("coverage"), 1);
    EXPECT_EQ(*at("garment"), 1);
    EXPECT_NEAR(*at("depth"), 3, 1e-3);
    EXPECT_NEAR(at("normal")[1], 1, 1e-6);
    EXPECT_NEAR(at("warp")[2], -1, 1e-6);
    EXPECT_NEAR(at("weft")[0], 0.6, 1e-6);
    EXPECT_NEAR(at("weft")[2], 0.8, 1e-6);
    EXPECT_NEAR(at("uv")[0], 3.5, 0.01);
    EXPECT_NEAR(at("uv")[1], 2.8, 0.01);
    for (std::size_t k = 0; k < 8; ++k)
        EXPECT_NEAR(at("albedo")[k], 0.3, 1e-5);
    EXPECT_EQ(*at("samples"), 8);
    EXPECT_EQ(aov_of(image, "albedo").channels, channel_names(image.basis, false));
    // Not a garment, no weft of its own: across warp and normal
    scene.objects[0].garment = false;
    scene.surfaces[0].weft.clear();
    const SpectralImage other = rendered(scene, quick(8), {"garment", "weft"});
    EXPECT_EQ(*other.aovs[0].pixel(8, 8), 0);
    EXPECT_NEAR(other.aovs[1].pixel(8, 8)[0], 1, 1e-6);
}

// The mean of what it says of the pixels is what the render says of all.
TEST(Aov, ErrorIsThatOfThePixels) {
    for (const bool everywhere : {false, true}) {
        RenderSettings settings = quick(16);
        settings.aovs = {"error"};
        if (everywhere)
            settings.stop.relative_error = 1e-6;
        const RenderResult result = render(folded_satin(33, 31), settings);
        const std::vector<float> &errors = result.image.aovs[0].data;
        const double mean =
            std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
        const double value =
            std::accumulate(result.image.transport.begin(), result.image.transport.end(), 0.0) /
            double(result.image.transport.size());
        EXPECT_NEAR(mean / value, result.stats.relative_error,
                    (everywhere ? 0.001 : 0.06) * result.stats.relative_error);
    }
}

TEST(Aov, AllSurviveStopAndResume) {
    Scene scene = lace();
    scene.camera.width = 70;
    scene.camera.height = 50;
    RenderSettings settings = quick(24);
    settings.aovs = aov_names();
    settings.alpha = true;
    const SpectralImage whole = render(scene, settings).image;
    settings.checkpoint = std::filesystem::path(testing::TempDir()) / "tsuya-aovs.checkpoint";
    std::atomic<bool> stop{false};
    const RenderResult part =
        render(scene, settings,
               {.report = [&](std::string_view stage,
                              double done) { stop = stage == "render" && done > 0.4; },
                .stop = &stop});
    ASSERT_TRUE(part.stats.interrupted);
    settings.resume = true;
    const SpectralImage resumed = render(scene, settings).image;
    std::filesystem::remove(settings.checkpoint);
    EXPECT_EQ(resumed.transport, whole.transport);
    EXPECT_EQ(resumed.alpha->data, whole.alpha->data);
    ASSERT_EQ(resumed.aovs.size(), aov_names().size());
    for (std::size_t i = 0; i < whole.aovs.size(); ++i)
        EXPECT_EQ(resumed.aovs[i].data, whole.aovs[i].data) << whole.aov_names[i];
}

TEST(Aov, OneThatIsNamedTwiceIsRefused) {
    RenderSettings settings = quick(1);
    settings.aovs = {"depth", "uv", "depth"};
    try {
        render(folded_satin(8, 8), settings);
        FAIL();
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].where, "aov");
        EXPECT_NE(error.problems()[0].what.find("'depth' is named twice"), std::string::npos);
    }
}

} // namespace

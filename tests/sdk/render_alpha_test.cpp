// Alpha and the part of a picture that is rendered.

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/aov_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A square before an environment: what it does not cover is empty, and what it shows stays.
TEST(Alpha, IsTheShareThatIsCovered) {
    Scene scene = lace();
    scene.objects.pop_back(); // no floor
    RenderSettings settings = quick(64);
    settings.aovs = {"coverage"};
    const SpectralImage plain = render(scene, settings).image;
    EXPECT_FALSE(plain.alpha);
    settings.alpha = true;
    const SpectralImage image = render(scene, settings).image;
    ASSERT_TRUE(image.alpha);
    EXPECT_EQ(image.alpha->data, image.aovs[0].data);
    std::size_t partly = 0, empty = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const float alpha = *image.alpha->pixel(x, y);
            empty += alpha == 0 ? 1 : 0;
            partly += alpha > 0 && alpha < 1 ? 1 : 0;
            // The environment behind is all that is gone
            const float behind = (1 - alpha) * static_cast<float>(scene.environment->radiance);
            EXPECT_NEAR(plain.pixel(1, x, y)[3] - image.pixel(1, x, y)[3], behind, 1e-5f);
            EXPECT_NEAR(plain.pixel(0, x, y)[3], image.pixel(0, x, y)[3], 1e-6f);
        }
    EXPECT_GT(empty, 50u);
    EXPECT_GT(partly, 20u);
}

// The same weights for the transport and for alpha: white tulle in white light stays white.
TEST(Alpha, IsDenoisedWithThePicture) {
    Scene scene = lace();
    scene.surfaces = {floor_square(20)};
    scene.surfaces[0].uv.assign(4, {0, 0});
    scene.objects.pop_back(); // the floor
    scene.textures[0].data.assign(4, 100);
    scene.camera.eye = {0, 5, 0};
    scene.camera.target = {0, 0, 0};
    scene.camera.up = {0, 0, -1};
    scene.fabrics = {lambert(1)};
    scene.lights.clear();
    scene.light_groups = {"key"};
    scene.environment = Environment{.radiance = 1};
    RenderSettings settings = quick(32);
    settings.max_bounces = 1000;
    settings.alpha = settings.denoise = true;
    settings.aovs = {"coverage"}; // alpha that is not denoised
    const SpectralImage image = render(scene, settings).image;
    double denoised = 0, raw = 0;
    for (int y = 0; y < 24; ++y)
        for (int x = 0; x < 24; ++x) {
            const float white = image.pixel(0, x, y)[2], alpha = *image.alpha->pixel(x, y);
            denoised += double(std::abs(white - alpha));
            raw += double(std::abs(white - *image.aovs[0].pixel(x, y)));
            EXPECT_LE(alpha, 1 + 1e-5f);
        }
    EXPECT_GT(raw, 24 * 24 * 0.004);
    EXPECT_LT(denoised, 0.25 * raw);
}

TEST(Crop, IsTheDataWindow) {
    RenderSettings settings = quick(4);
    EXPECT_FALSE(render(folded_satin(16, 16), settings).image.data_window);
    settings.crop = {3, 5, 12, 9};
    const SpectralImage image = render(folded_satin(16, 16), settings).image;
    EXPECT_EQ(image.width, 16);
    EXPECT_EQ(image.data_window, settings.crop);
    EXPECT_GT(image.pixel(0, 11, 8)[0] + image.pixel(1, 11, 8)[0], 0);
    EXPECT_EQ(image.pixel(0, 12, 8)[0] + image.pixel(1, 12, 8)[0], 0);
}

} // namespace

// Pictured environments: turned, and in several light groups.

#include <cmath>

#include <gtest/gtest.h>

#include "sdk/render_scenes.h"

namespace {

using namespace tsuya;
using namespace tsuya::test;

// A sky of three patches, each in another channel.
Image patches() {
    Image picture = Image::make(16, 8, {"R", "G", "B"});
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 16; ++x) {
            picture.pixel(x, y)[0] = x < 6 && y < 4 ? 3.0f : 0.1f;
            picture.pixel(x, y)[1] = x >= 6 && y < 5 ? 1.0f : 0.0f;
            picture.pixel(x, y)[2] = y < 2 ? 2.0f : 0.2f;
        }
    return picture;
}

Scene under(const Image &picture) {
    Scene scene = folded_satin(12, 12);
    scene.lights.clear();
    scene.light_groups = {"red", "green", "blue"};
    scene.environment = Environment{.radiance = 0.5, .picture = picture};
    return scene;
}

double mean(const SpectralImage &image, std::size_t group) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            sum += double(image.pixel(group, x, y)[1]) / image.width / image.height;
    return sum;
}

TEST(PicturedEnvironment, ChannelsAreAsEnvironmentsOfTheirOwn) {
    Scene all = under(patches());
    all.environment->further_groups = {{1}, {2}};
    const SpectralImage together = render(all, quick(512)).image;
    for (std::size_t c = 0; c < 3; ++c) {
        Image one = patches();
        for (int y = 0; y < one.height; ++y)
            for (int x = 0; x < one.width; ++x)
                one.pixel(x, y)[0] = one.pixel(x, y)[c];
        const SpectralImage alone = render(under(one), quick(512)).image;
        EXPECT_NEAR(mean(together, c), mean(alone, 0), 0.015 * mean(alone, 0)) << c;
    }
}

TEST(PicturedEnvironment, TurnsAboutTheVertical) {
    const Image picture = patches();
    Scene turned = under(picture);
    turned.environment->turn = 2 * kPi * 5 / 16; // five columns: from +z to +x
    Image shifted = picture;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            std::copy_n(picture.pixel(x, y), 3, shifted.pixel((x + 5) % 16, y));
    const double by_turn = mean(render(turned, quick(256)).image, 0);
    const double by_shift = mean(render(under(shifted), quick(256)).image, 0);
    EXPECT_NEAR(by_turn, by_shift, 0.01 * by_shift);
    const double unturned = mean(render(under(picture), quick(256)).image, 0);
    EXPECT_GT(std::abs(unturned - by_shift), 0.03 * by_shift); // negative control
}

TEST(PicturedEnvironment, IsRefusedAtItsPlace) {
    Scene scene = under(patches());
    scene.environment->further_groups = {{1}, {2}};
    EXPECT_EQ(place_of_fault(scene), "accepted");
    scene.environment->further_groups = {{1}, {7}};
    EXPECT_EQ(place_of_fault(scene), "environment.further_groups");
    scene.environment->further_groups = {{1}, {2}, {0}};
    EXPECT_EQ(place_of_fault(scene), "environment.further_groups");
    scene.environment->further_groups = {{1}};
    scene.environment->picture.reset();
    EXPECT_EQ(place_of_fault(scene), "environment.further_groups");
    scene.environment->further_groups.clear();
    scene.environment->turn = NAN;
    EXPECT_EQ(place_of_fault(scene), "environment.turn");
}

} // namespace

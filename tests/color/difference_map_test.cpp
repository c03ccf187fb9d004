#include "tsuya/color/difference_map.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"

namespace tsuya {
namespace {

// Crimson, grey, crimson of half the light, and beyond the garment.
SpectralImage four_pixels() {
    SpectralImage image = SpectralImage::make(4, 1, {.count = 16}, {"key"});
    const std::vector<float> crimson = project(dye("crimson"), image.basis);
    for (int k = 0; k < 16; ++k) {
        image.pixel(0, 0, 0)[k] = crimson[static_cast<std::size_t>(k)];
        image.pixel(0, 1, 0)[k] = 0.3f;
        image.pixel(0, 2, 0)[k] = 0.5f * crimson[static_cast<std::size_t>(k)];
        image.pixel(0, 3, 0)[k] = 0.7f;
    }
    image.aovs = {Image::make(4, 1, {"Y"})};
    image.aovs[0].data = {1, 1, 1, 0};
    image.aov_names = {"garment"};
    return image;
}

Lighting under(const char *name) { return lighting_of({.name = name, .spectrum = lamp(name)}); }

TEST(DifferenceMap, HasTheDifferencesOfTheComparison) {
    const SpectralImage image = four_pixels();
    const Image map = difference_map(image, under("D65"), under("A"));
    ASSERT_EQ(map.channels.size(), 1u);
    EXPECT_GT(map.data[0], 1);
    EXPECT_LT(map.data[1], 0.01f);
    EXPECT_GT(map.data[2], 1);
    EXPECT_TRUE(std::isnan(map.data[3]));
    const std::vector<NamedLamp> lamps{{.name = "D65", .spectrum = lamp("D65")},
                                       {.name = "A", .spectrum = lamp("A")}};
    const LampDifference all = compare_lamps(image, lamps)[0];
    EXPECT_NEAR((map.data[0] + map.data[1] + map.data[2]) / 3, all.mean, 1e-5);
    EXPECT_NEAR(std::max(map.data[0], map.data[2]), all.max, 1e-5);
}

double lightness(const float *rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

TEST(DifferenceMap, IsBrighterWhereColoursPart) {
    Image map = Image::make(101, 1, {"CIEDE2000"});
    for (int x = 0; x < 101; ++x)
        map.data[static_cast<std::size_t>(x)] = 0.1f * static_cast<float>(x);
    const Image picture = picture_of_differences(map);
    for (int x = 1; x < 101; ++x)
        EXPECT_GT(lightness(picture.pixel(x, 0)), lightness(picture.pixel(x - 1, 0))) << x;
    map.data[0] = 1000;
    EXPECT_EQ(picture_of_differences(map).pixel(0, 0)[1], picture.pixel(100, 0)[1]);
}

TEST(DifferenceMap, TheLegendHasItsColoursBesideItsNumbers) {
    const SheetPicture legend = difference_legend(200, 400);
    ASSERT_GE(legend.marks.size(), 5u);
    for (const SheetMark &mark : legend.marks) {
        const Image of_it = picture_of_differences(
            Image{1, 1, {"CIEDE2000"}, {static_cast<float>(std::atof(mark.text.c_str()))}});
        const int y = std::clamp(static_cast<int>(mark.y * 400), 33, 366);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(legend.image.pixel(45, y)[c], of_it.data[static_cast<std::size_t>(c)], 0.03)
                << mark.text;
    }
}

} // namespace
} // namespace tsuya

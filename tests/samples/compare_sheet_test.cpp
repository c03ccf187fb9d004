#include "tsuya/scene/compare_sheet.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tsuya/color/color_report.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"
#include "tsuya/scene/picture.h"

namespace tsuya::scene {
namespace {

SpectralImage cloth(int width, int height) {
    SpectralImage image = SpectralImage::make(width, height, {.count = 16}, {"key"});
    const std::vector<float> crimson = project(dye("crimson"), image.basis);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            std::copy(crimson.begin(), crimson.end(), image.pixel(0, x, y));
    return image;
}

std::vector<NamedLamp> named(const std::vector<std::string> &names) { return parse_lamps(names); }

Sheet sheet_of(const SpectralImage &image, const std::vector<NamedLamp> &lamps,
               double picture_stops = 0, double figure_stops = 0) {
    ColorReporter reporter({.exposure_stops = figure_stops});
    ReportPicture picture{.name = "a"};
    for (const NamedLamp &lamp : lamps)
        picture.lightings.push_back(lighting_of(lamp));
    reporter.add(picture, image);
    DisplayOptions look = default_look();
    look.exposure_stops = picture_stops;
    CompareSheet sheet(lamps, look, Observer::cie1964, figure_stops);
    sheet.add("crimson", image, reporter.report().parts);
    return sheet.sheet();
}

TEST(CompareSheet, HasAtMostFourColumns) {
    const Sheet sheet = sheet_of(cloth(24, 30), named({"D65", "A", "FL11", "HP4", "LED-B3"}));
    EXPECT_EQ(sheet.columns, 3); // of five, three and two
    EXPECT_EQ(sheet_columns(4), 4);
    EXPECT_EQ(sheet_columns(14), 4);
    EXPECT_EQ(sheet_columns(9), 3);
    // Adapted, as a camera, maps, swatches: two rows each
    ASSERT_EQ(sheet.pictures.size(), 24u);
    ASSERT_EQ(sheet.row_labels.size(), 8u);
    EXPECT_EQ(sheet.row_labels[0], "crimson\nadapted");
    EXPECT_EQ(sheet.row_labels[1], "");
    EXPECT_NE(sheet.pictures[0].caption.find("6504 K"), std::string::npos);
    EXPECT_NE(sheet.pictures[0].caption.find("\nRa 100"), std::string::npos);
    EXPECT_NE(sheet.pictures[0].caption.find("gamut"), std::string::npos);
    EXPECT_EQ(sheet.pictures[12].caption, "CIEDE2000 of the adapted pictures");
    EXPECT_NE(sheet.pictures[13].caption.find("A against D65: mean "), std::string::npos);
    EXPECT_TRUE(sheet.pictures[5].image.data.empty()); // filled up
    ASSERT_EQ(sheet.pictures[18].marks.size(), 2u);
    EXPECT_EQ(sheet.pictures[18].marks[1].text.rfind("L* ", 0), 0u);
    EXPECT_GT(draw_sheet(sheet).width, 3 * 24);
}

TEST(CompareSheet, ALineHasNoMap) {
    NamedLamp line{.name = "violet", .spectrum = {{430, 436, 442}, {0, 1, 0}}};
    std::vector<NamedLamp> lamps = named({"D65"});
    lamps.push_back(line);
    const Sheet sheet = sheet_of(cloth(24, 30), lamps);
    ASSERT_EQ(sheet.pictures.size(), 8u);
    EXPECT_FALSE(sheet.pictures[1].image.data.empty());
    EXPECT_TRUE(sheet.pictures[5].image.data.empty());
}

TEST(CompareSheet, FiguresKeepTheirOwnExposure) {
    const std::vector<NamedLamp> lamps = named({"D65", "A"});
    const Sheet plain = sheet_of(cloth(24, 30), lamps),
                brighter = sheet_of(cloth(24, 30), lamps, 1),
                all_brighter = sheet_of(cloth(24, 30), lamps, 1, 1);
    ASSERT_EQ(plain.pictures.size(), 8u); // adapted, as a camera, maps, swatches
    EXPECT_EQ(brighter.pictures[5].caption, plain.pictures[5].caption);
    EXPECT_NE(all_brighter.pictures[5].caption, plain.pictures[5].caption);
    EXPECT_EQ(brighter.pictures[7].marks.at(1).text, plain.pictures[7].marks.at(1).text);
    EXPECT_NE(all_brighter.pictures[7].marks.at(1).text, plain.pictures[7].marks.at(1).text);
    // Swatches are as bright as the pictures.
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        EXPECT_GT(brighter.pictures[7].image.data[channel], plain.pictures[7].image.data[channel]);
        EXPECT_NEAR(brighter.pictures[7].image.data[channel],
                    all_brighter.pictures[7].image.data[channel], 1e-4);
    }
}

TEST(SmallerTransport, HasTheMeanOfSquares) {
    SpectralImage image = SpectralImage::make(5, 3, {.count = 8}, {"key", "fill"});
    for (std::size_t i = 0; i < image.transport.size(); ++i)
        image.transport[i] = static_cast<float>(i % 97);
    image.alpha = Image::make(5, 3, {"A"});
    image.alpha->data[4] = 1;
    image.aovs = {Image::make(5, 3, {"Y"}), Image::make(5, 3, {"X", "Y", "Z"})};
    image.aov_names = {"garment", "normal"};
    const SpectralImage small = smaller_transport(image, 2);
    EXPECT_EQ(small.width, 3);
    EXPECT_EQ(small.height, 2);
    EXPECT_EQ(small.aov_names, (std::vector<std::string>{"garment"}));
    EXPECT_FLOAT_EQ(small.pixel(1, 0, 0)[3], (image.pixel(1, 0, 0)[3] + image.pixel(1, 1, 0)[3] +
                                              image.pixel(1, 0, 1)[3] + image.pixel(1, 1, 1)[3]) /
                                                 4);
    EXPECT_FLOAT_EQ(small.pixel(0, 2, 1)[5], image.pixel(0, 4, 2)[5]);
    EXPECT_FLOAT_EQ(small.alpha->data[2], 0.5f);
}

} // namespace
} // namespace tsuya::scene

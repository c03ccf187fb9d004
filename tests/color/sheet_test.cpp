#include "tsuya/color/sheet.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "color_test.h"

namespace tsuya {
namespace {

SheetPicture picture(float level, std::string caption, int width = 120, int height = 90) {
    Image image = Image::make(width, height, {"R", "G", "B"});
    std::fill(image.data.begin(), image.data.end(), level);
    return {std::move(image), std::move(caption)};
}

bool has_font() {
    try {
        draw_sheet({.pictures = {picture(0.5f, "D65")}});
        return true;
    } catch (const Error &) {
        return false;
    }
}

// Pixels of each value: pictures are of one level each, so they can be counted.
std::ptrdiff_t count(const Image &image, float level) {
    return std::count(image.data.begin(), image.data.end(), level) / 3;
}

TEST(Sheet, PlacesPicturesRowByRow) {
    Sheet sheet{.pictures = {picture(0.25f, ""), picture(0.5f, ""), picture(0.75f, "")},
                .columns = 2};
    const Image out = draw_sheet(sheet); // no word: no font is needed
    for (const float level : {0.25f, 0.5f, 0.75f})
        EXPECT_EQ(count(out, level), 120 * 90) << level;
    EXPECT_GT(out.width, 2 * 120);
    EXPECT_LT(out.width, 3 * 120);
    const auto first_row_of = [&](float level) {
        return (std::find(out.data.begin(), out.data.end(), level) - out.data.begin()) / 3 /
               out.width;
    };
    EXPECT_EQ(first_row_of(0.25f), first_row_of(0.5f));
    EXPECT_GT(first_row_of(0.75f), first_row_of(0.5f) + 89);
    // Something of the background stands between pictures, and around them.
    const int y = static_cast<int>(first_row_of(0.25f));
    const float background = out.data[0];
    int x = 0;
    for (const float level : {0.25f, 0.5f}) {
        EXPECT_EQ(*out.pixel(x, y), background);
        while (x < out.width && *out.pixel(x, y) == background)
            ++x;
        ASSERT_LE(x + 120, out.width);
        EXPECT_EQ(*out.pixel(x, y), level);
        EXPECT_EQ(*out.pixel(x + 119, y), level);
        x += 120;
    }
    EXPECT_EQ(*out.pixel(x, y), background);
    sheet.columns = 0;
    EXPECT_GT(draw_sheet(sheet).width, 3 * 120);
}

TEST(Sheet, WritesWordsOutsideThePictures) {
    if (!has_font())
        GTEST_SKIP() << "no font on this system";
    const Sheet bare{.pictures = {picture(0.5f, ""), picture(0.5f, "")}, .columns = 1};
    const Image without = draw_sheet(bare);
    Sheet worded = bare;
    worded.title = "Satin, \xE8\x89\xB6"; // a letter that the font lacks is no error
    worded.pictures[0].caption = "HP4, metal halide of 4002 K, a caption that is much too long";
    worded.row_labels = {"crimson", "indigo"};
    for (const SheetTheme theme : {SheetTheme::light, SheetTheme::dark}) {
        worded.theme = theme;
        const Image with = draw_sheet(worded);
        EXPECT_EQ(count(with, 0.5f), 2 * 120 * 90); // no letter lies on a picture
        EXPECT_GT(with.width, without.width);
        EXPECT_GT(with.height, without.height);
        const float background = with.data[0];
        const auto ink = static_cast<std::ptrdiff_t>(with.width) * with.height - 2 * 120 * 90 -
                         count(with, background);
        EXPECT_GT(ink, 300);
        for (const float v : with.data)
            ASSERT_TRUE(v >= 0 && v <= 1);
    }
}

TEST(Sheet, RowsOfTheirOwnHeightHaveEmptyPlaces) {
    Sheet sheet{.columns = 2};
    add_rows(sheet, "", {picture(0.25f, ""), picture(0.5f, ""), picture(0.75f, "")});
    add_rows(sheet, "", {picture(0.35f, "", 120, 30)});
    ASSERT_EQ(sheet.pictures.size(), 6u);
    EXPECT_EQ(sheet.row_labels.size(), 3u);
    const Image out = draw_sheet(sheet);
    for (const float level : {0.25f, 0.5f, 0.75f})
        EXPECT_EQ(count(out, level), 120 * 90) << level;
    EXPECT_EQ(count(out, 0.35f), 120 * 30);
    EXPECT_LT(out.height, 4 * 90); // the row of 30 is no higher
    EXPECT_GT(out.height, 2 * 90 + 30);
}

TEST(Sheet, WritesMarksOnPictures) {
    if (!has_font())
        GTEST_SKIP() << "no font on this system";
    Sheet sheet{.pictures = {picture(0.25f, "two\nlines"), picture(0.75f, "")}, .columns = 2};
    const Image plain = draw_sheet(sheet);
    sheet.pictures[0].marks = {{0.1, 0.5, "L* 50"}};
    sheet.pictures[1].marks = {{0.1, 0.5, "L* 80"}};
    const Image out = draw_sheet(sheet);
    ASSERT_EQ(out.data.size(), plain.data.size());
    std::array<int, 2> lighter{}, darker{}; // pixels of the left and of the right picture
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x) {
            const float change = out.pixel(x, y)[1] - plain.pixel(x, y)[1];
            const std::size_t half = 2 * x < out.width ? 0 : 1;
            lighter[half] += change > 0 ? 1 : 0;
            darker[half] += change < 0 ? 1 : 0;
        }
    EXPECT_GT(lighter[0], 50); // white on the dark one
    EXPECT_EQ(darker[0], 0);
    EXPECT_GT(darker[1], 50); // black on the light one
    EXPECT_EQ(lighter[1], 0);
    sheet.pictures[0].caption = "one";
    EXPECT_LT(draw_sheet(sheet).height, plain.height);
}

TEST(Sheet, RefusesWrongInput) {
    test::expect_problem([] { draw_sheet({}); }, "sheet.pictures", "no picture");
    test::expect_problem([] { draw_sheet({.pictures = {picture(0, "")}, .columns = -1}); },
                         "sheet.columns", "-1 columns");
    test::expect_problem(
        [] {
            draw_sheet({.pictures = {picture(0, ""), picture(0, "", 119)}});
        },
        "sheet.pictures.1", "119 x 90");
    test::expect_problem(
        [] {
            draw_sheet({.pictures = {picture(0, ""), picture(0, "", 120, 91)}});
        },
        "sheet.pictures.1", "expected the height of its row, 90");
    test::expect_problem([] { draw_sheet({.pictures = {{}}}); }, "sheet.pictures", "no picture");
    test::expect_problem(
        [] {
            draw_sheet({.pictures = {{Image::make(2, 2, {"X", "Y", "Z"}), ""}}});
        },
        "sheet.pictures.0", "no channel R");
    test::expect_problem(
        [] {
            draw_sheet({.pictures = {picture(0, "")}, .row_labels = {"a", "b"}});
        },
        "sheet.row_labels", "2 row labels for 1 row");
    test::expect_problem(
        [] { draw_sheet({.title = "t", .pictures = {picture(0, "c")}, .font = "/no/font.ttf"}); },
        "sheet.font", "/no/font.ttf");
}

} // namespace
} // namespace tsuya

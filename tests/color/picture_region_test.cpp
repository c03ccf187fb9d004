#include "tsuya/color/picture_region.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "color_test.h"

namespace tsuya {
namespace {

// Ids of [Cryptomatte] by hand: pixel 0 is all satin, 1 is satin to 98.5 % and form, 2 is form by
// half and satin by 0.4, 3 is form by 0.3.
SpectralImage with_ids() {
    SpectralImage image = SpectralImage::make(4, 1, {.count = 8}, {"key"});
    std::fill(image.transport.begin(), image.transport.end(), 0.5f);
    const float satin = std::bit_cast<float>(std::uint32_t{0x3f0a1b2c}),
                form = std::bit_cast<float>(std::uint32_t{0x41aabbcc});
    Image ids = Image::make(4, 1, {"a", "b", "c", "d"});
    ids.data = {satin, 1,    0,     0,    satin, 0.985f, form, 0.015f,
                form,  0.5f, satin, 0.4f, form,  0.3f,   0,    0};
    image.aovs = {ids};
    image.aov_names = {"CryptoFabric"};
    image.metadata = {
        {"cryptomatte/1234567/name", "CryptoFabric"},
        {"cryptomatte/1234567/manifest", R"({"satin \"a\"":"3f0a1b2c","form":"41aabbcc"})"}};
    return image;
}

TEST(PictureRegion, HasThePixelsThatAPartFills) {
    const std::vector<PictureRegion> regions = picture_regions(with_ids());
    ASSERT_EQ(regions.size(), 3u);
    EXPECT_EQ(regions[0].kind, "garment");
    EXPECT_EQ(regions[0].pixels, (std::vector<std::size_t>{0, 1, 2, 3}));
    EXPECT_EQ(regions[1].kind, "fabric");
    EXPECT_EQ(regions[1].name, "form"); // it fills none: those covered by half
    EXPECT_EQ(regions[1].pixels, (std::vector<std::size_t>{2}));
    EXPECT_EQ(regions[2].name, "satin \"a\"");
    EXPECT_EQ(regions[2].pixels, (std::vector<std::size_t>{0, 1}));
}

TEST(PictureRegion, ReadsEscapedNames) {
    const auto names_of = [](const std::string &name) {
        SpectralImage image = with_ids();
        image.metadata["cryptomatte/1234567/manifest"] = "{\"" + name + "\":\"41aabbcc\"}";
        return picture_regions(image).at(1).name;
    };
    EXPECT_EQ(names_of(R"(\u0041\u00e9\u7d39\ud83d\udc57)"), "A\u00e9\u7d39\U0001f457");
    EXPECT_EQ(names_of(R"(\u07FFa\u0800)"), "\u07ffa\u0800");
    EXPECT_EQ(names_of(R"(a\nb\u0009c\/d)"), "a b c/d");
    // Half of a pair
    EXPECT_EQ(names_of(R"(\ud83da)"), "\ufffda");
    EXPECT_EQ(names_of(R"(\ud83d\u0041)"), "\ufffdA");
    EXPECT_EQ(names_of(R"(\udc57)"), "\ufffd");
}

TEST(PictureRegion, KeepsPartsOfOneName) {
    SpectralImage image = with_ids();
    image.metadata["cryptomatte/1234567/manifest"] = R"({"silk":"3f0a1b2c","silk":"41aabbcc"})";
    const std::vector<PictureRegion> regions = picture_regions(image);
    ASSERT_EQ(regions.size(), 3u);
    EXPECT_EQ(regions[1].name, "silk");
    EXPECT_EQ(regions[1].pixels, (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(regions[2].name, "silk");
    EXPECT_EQ(regions[2].pixels, (std::vector<std::size_t>{2}));
}

TEST(PictureRegion, LeavesOutWhatIsNotFinite) {
    SpectralImage image = with_ids();
    image.pixel(0, 0, 0)[3] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(picture_regions(image)[2].pixels, (std::vector<std::size_t>{1}));
    EXPECT_EQ(picture_regions(image)[0].pixels, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(PictureRegion, TheGarmentIsWhatItsCoverageSays) {
    SpectralImage image = with_ids();
    image.aovs.push_back(Image::make(4, 1, {"Y"}));
    image.aovs[1].data = {0.5f, 0.6f, 0.4f, 0.0f};
    image.aov_names.push_back("garment");
    EXPECT_EQ(picture_regions(image)[0].pixels, (std::vector<std::size_t>{0, 1}));
    image.aovs[1].data[0] = 1;
    EXPECT_EQ(picture_regions(image)[0].pixels, (std::vector<std::size_t>{0}));
    image.aovs[1].data = {0, 0, 0, 0};
    EXPECT_EQ(picture_regions(image)[0].kind, "fabric");
}

TEST(PictureRegion, RefusesIdsWithoutNames) {
    for (const char *manifest : {"", "{", "{\"a\":\"xyz\"}", "{\"a\" \"12\"}", "{\"a\":\"12\"",
                                 R"({"\u00g1":"12"})", R"({"\u00)"}) {
        SpectralImage image = with_ids();
        image.metadata["cryptomatte/1234567/manifest"] = manifest;
        test::expect_problem([&] { picture_regions(image); }, "CryptoFabric", "manifest");
    }
    SpectralImage image = with_ids();
    image.metadata.clear();
    test::expect_problem([&] { picture_regions(image); }, "CryptoFabric", "manifest");
}

} // namespace
} // namespace tsuya

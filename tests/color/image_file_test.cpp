#include "tsuya/color/image_file.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "color_test.h"
#include "some_pictures.h"
#include "tsuya/color/print_file.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

using namespace tsuya::test;

TEST(ImageFile, TwoFilesOfOnePictureHaveTheSameBytes) {
    const test::Folder folder;
    const Image image = Image::make(40, 300, {"R", "G", "B"});
    for (const char *const ending : {".exr", ".png"}) {
        const auto bytes = [&](const std::string &name) {
            if (std::string(ending) == ".png")
                write_png(folder / (name + ending), image);
            else
                write_exr(folder / (name + ending), image);
            return read_file(folder / (name + ending));
        };
        const std::string first = bytes("a");
        std::this_thread::sleep_for(std::chrono::milliseconds(1100)); // another second
        EXPECT_EQ(first, bytes("b")) << ending;
    }
}

// As PNG has it: colours are not multiplied by alpha, in the file and where it is read as artwork.
TEST(ImageFile, PngHasUnassociatedAlpha) {
    const test::Folder folder;
    Image image = Image::make(3, 1, {"R", "G", "B", "A"});
    image.data = {1, 0.6f, 0.2f, 0.4f, 0.8f, 0.8f, 0.8f, 0, 0.4f, 1, 0, 1};
    write_png(folder / "a.png", image);
    const Texture back = read_artwork(folder / "a.png");
    ASSERT_EQ(back.channels, 4);
    for (const std::size_t i : {0, 1, 2, 3, 7, 8, 9, 10, 11})
        EXPECT_NEAR(back.data[i], 255 * image.data[i], 0.51f) << i;
}

TEST(ImageFile, PngKeepsCodeValues) {
    const test::Folder folder;
    for (const auto &channels : {std::vector<std::string>{"Y"}, {"R", "G", "B"}}) {
        const Image image = ramp(31, 17, channels);
        for (const int bits : {8, 16}) {
            write_png(folder / "p.png", image, bits);
            const Image back = read_image(folder / "p.png");
            ASSERT_EQ(back.width, 31);
            ASSERT_EQ(back.height, 17);
            ASSERT_EQ(back.channels.size(), channels.size());
            for (std::size_t i = 0; i < image.data.size(); ++i)
                ASSERT_NEAR(back.data[i], image.data[i], 1e-6f) << i;
        }
    }
    EXPECT_EQ(folder.size(), 1);
}

/// The bytes of a chunk of a PNG, without its length and sum; empty where it has none.
std::string chunk_of(const std::string &png, const std::string &name) {
    for (std::size_t at = 8; at + 8 <= png.size();) {
        std::size_t length = 0;
        for (std::size_t i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(png[at + i]);
        if (png.substr(at + 4, 4) == name)
            return png.substr(at + 8, length);
        at += 12 + length;
    }
    return "";
}

TEST(ImageFile, WritesWhatTheEndingSays) {
    const test::Folder folder;
    const Image image = ramp(31, 17, {"R", "G", "B"});
    const auto begins_with = [&](const char *name, const std::string &bytes) {
        return read_file(folder / name).substr(0, bytes.size()) == bytes;
    };
    for (const char *name : {"a.png", "a.tif", "a.tiff"})
        for (const int bits : {8, 16}) {
            write_picture(folder / name, image, {.bits = bits});
            EXPECT_TRUE(std::string(name) == "a.png"
                            ? begins_with(name, "\x89P")
                            : begins_with(name, "II") || begins_with(name, "MM"))
                << name;
            const Image back = read_image(folder / name);
            ASSERT_EQ(back.channels.size(), 3u) << name;
            for (std::size_t i = 0; i < image.data.size(); ++i)
                ASSERT_NEAR(back.data[i], image.data[i], 1e-6f) << name << i;
        }
    Image flat = Image::make(32, 16, {"R", "G", "B"});
    for (std::size_t i = 0; i < flat.data.size(); ++i)
        flat.data[i] = i % 3 == 0 ? 0.8f : 0.3f;
    for (const char *name : {"a.jpg", "a.jpeg"}) {
        write_picture(folder / name, flat);
        EXPECT_TRUE(begins_with(name, "\xff\xd8")) << name;
        EXPECT_NEAR(read_image(folder / name).data[300], 0.8f, 0.02f) << name;
        EXPECT_NEAR(read_image(folder / name).data[301], 0.3f, 0.02f) << name;
    }
    const Image alpha = ramp(5, 4, {"R", "G", "B", "A"});
    write_picture(folder / "alpha.tif", alpha, {.bits = 16});
    EXPECT_EQ(read_image(folder / "alpha.tif").channels.size(), 4u);
}

TEST(ImageFile, CarriesTheProfileOfItsDisplay) {
    const test::Folder folder;
    const Image image = ramp(16, 16, {"R", "G", "B"});
    const auto written = [&](const char *name, const PictureFileOptions &options) {
        write_picture(folder / name, image, options);
        return read_file(folder / name);
    };
    EXPECT_FALSE(chunk_of(written("a.png", {}), "sRGB").empty());
    EXPECT_EQ(chunk_of(written("a.png", {}), "iCCP"), "");
    const std::string wide = written("wide.png", {.display = "Display P3"});
    EXPECT_FALSE(chunk_of(wide, "iCCP").empty());
    EXPECT_EQ(chunk_of(wide, "sRGB"), "");
    EXPECT_EQ(wide, written("again.png", {.display = "Display P3"})); // no date in it
    for (const char *name : {"wide.tif", "wide.jpg"})
        EXPECT_NE(written(name, {.display = "Display P3"}).find("acsp"), std::string::npos) << name;
    // Its name, in UTF-16
    EXPECT_NE(written("wide.tif", {.display = "Display P3"})
                  .find(std::string("\0P\0"
                                    "3",
                                    4)),
              std::string::npos);
    EXPECT_EQ(chunk_of(written("pq.png", {.bits = 16, .display = "Rec.2100-PQ"}), "cICP"),
              std::string("\x09\x10\x00\x01", 4));
    EXPECT_EQ(chunk_of(written("hlg.png", {.display = "Rec.2100-HLG"}), "cICP"),
              std::string("\x09\x12\x00\x01", 4));
    EXPECT_NEAR(read_image(folder / "pq.png").data[17], image.data[17], 1e-5f); // the CRC is right
    EXPECT_EQ(chunk_of(written("none.png", {.display = ""}), "sRGB"), "");
}

TEST(ImageFile, ExrStatesItsPrimaries) {
    const test::Folder folder;
    const Image image = ramp(8, 8, {"R", "G", "B"});
    write_exr(folder / "a.exr", image, {.primaries = kRec709});
    const std::string bytes = read_file(folder / "a.exr");
    const std::size_t at = bytes.find(std::string("chromaticities\0chromaticities\0", 30));
    ASSERT_NE(at, std::string::npos);
    float red_x = 0;
    std::memcpy(&red_x, bytes.data() + at + 34, sizeof red_x);
    EXPECT_EQ(red_x, 0.64f);
    write_exr(folder / "b.exr", image);
    EXPECT_EQ(read_file(folder / "b.exr").find("chromaticities"), std::string::npos);
}

TEST(ImageFile, PngClampsAndRounds) {
    const test::Folder folder;
    write_png(folder / "p.png",
              Image{3, 1, {"Y"}, {-0.5f, std::numeric_limits<float>::infinity(), 100.4f / 255}});
    const Image back = read_image(folder / "p.png");
    EXPECT_EQ(back.data[0], 0.0f);
    EXPECT_EQ(back.data[1], 1.0f);
    EXPECT_NEAR(back.data[2], 100.0f / 255, 1e-6f);
}

TEST(ImageFile, ExrIsExactAndKeepsNames) {
    const test::Folder folder;
    Image image = ramp(40, 33, {"Z", "b", "X", "layer.q"});
    image.data[5] = std::numeric_limits<float>::infinity();
    image.data[6] = 1e-30f;
    write_exr(folder / "x.exr", image);
    const Image back = read_image(folder / "x.exr");
    ASSERT_EQ(back.channels.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c) {
        const auto at = static_cast<std::size_t>(
            std::find(back.channels.begin(), back.channels.end(), image.channels[c]) -
            back.channels.begin());
        ASSERT_LT(at, 4u) << image.channels[c];
        for (std::size_t p = 0; p < image.data.size(); p += 4)
            ASSERT_EQ(back.data[p + at], image.data[p + c]);
    }
    write_exr(folder / "half.exr", image, {.samples = SampleType::half});
    EXPECT_LT(std::filesystem::file_size(folder / "half.exr"),
              std::filesystem::file_size(folder / "x.exr"));
}

TEST(ImageFile, TallPictureIsExact) {
    // More rows than are written at once.
    const test::Folder folder;
    Image image = Image::make(3, 333, {"Y"});
    for (std::size_t i = 0; i < image.data.size(); ++i)
        image.data[i] = static_cast<float>(i);
    write_exr(folder / "tall.exr", image);
    EXPECT_EQ(read_image(folder / "tall.exr").data, image.data);
}

} // namespace
} // namespace tsuya

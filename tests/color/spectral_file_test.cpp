// Spectral EXR files: what is written comes back, with its place, alpha and names.

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "color_test.h"
#include "some_pictures.h"
#include "tsuya/color/image_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

using namespace tsuya::test;

const SpectralExrOptions kFloats{.samples = SampleType::float32};

SpectralImage transport_of_dyes() {
    SpectralImage image = SpectralImage::make(5, 4, {.count = 16}, {"key"});
    for (std::size_t i = 0; i < image.transport.size(); ++i)
        image.transport[i] = static_cast<float>(i) / 7;
    image.depths = make_dye_depths(
        {{.name = "silk",
          .dye = {{400, 550.25, 700}, {0.1, 1.0 / 3, 0.9}},
          .open = true,
          .highest = 0.953},
         {.name = "linen.weft", .dye = Spectrum::constant(0.4), .lowest = 0.3, .highest = 0.5}},
        16);
    return image;
}

TEST(SpectralFile, DepthsOfDyeAreKeptToTheLastBit) {
    const test::Folder folder;
    const SpectralImage image = transport_of_dyes();
    write_spectral_exr(folder / "d.exr", image, kFloats);
    const SpectralImage back = read_spectral_exr(folder / "d.exr");
    EXPECT_EQ(back.depths, image.depths);
    EXPECT_EQ(back.basis.count, 16);
    EXPECT_TRUE(same_bits(back.transport, image.transport));
    EXPECT_NE(read_file(folder / "d.exr").find("T.depth.07"), std::string::npos);
}

TEST(SpectralFile, DepthsOfDyeThatDoNotFitAreRefused) {
    const test::Folder folder;
    SpectralImage image = transport_of_dyes();
    image.depths->node.pop_back();
    image.depths->degree.pop_back();
    EXPECT_THROW(write_spectral_exr(folder / "d.exr", image), Error);
    image.depths->degree.push_back({0, 0}); // of which there is one already
    image.depths->node.push_back({0.1, 0.3});
    EXPECT_THROW(write_spectral_exr(folder / "d.exr", image), Error);
    EXPECT_EQ(folder.size(), 0);
}

TEST(SpectralFile, RoundTripIsExact) {
    const test::Folder folder;
    const SpectralImage image = some_transport();
    write_spectral_exr(folder / "t.exr", image, kFloats);
    const SpectralImage back = read_spectral_exr(folder / "t.exr");
    EXPECT_EQ(back.width, image.width);
    EXPECT_EQ(back.height, image.height);
    EXPECT_EQ(back.basis, image.basis);
    EXPECT_EQ(back.groups, image.groups);
    EXPECT_TRUE(same_bits(back.transport, image.transport));
    EXPECT_EQ(back.aov_names, image.aov_names);
    ASSERT_EQ(back.aovs.size(), image.aovs.size());
    for (std::size_t i = 0; i < image.aovs.size(); ++i) {
        EXPECT_EQ(back.aovs[i].channels, image.aovs[i].channels);
        EXPECT_TRUE(same_bits(back.aovs[i].data, image.aovs[i].data));
    }
    EXPECT_EQ(back.metadata, image.metadata);
    EXPECT_EQ(folder.size(), 1);
}

TEST(SpectralFile, PartKeepsItsPlaceAndAlpha) {
    const test::Folder folder;
    SpectralImage image = some_transport();
    image.alpha = ramp(37, 29, {"A"});
    image.data_window = {5, 11, 30, 27};
    const auto is_inside = [](int x, int y) { return x >= 5 && x < 30 && y >= 11 && y < 27; };
    write_spectral_exr(folder / "part.exr", image, kFloats);
    const SpectralImage back = read_spectral_exr(folder / "part.exr");
    EXPECT_EQ(back.width, 37);
    EXPECT_EQ(back.height, 29);
    EXPECT_EQ(back.data_window, image.data_window);
    ASSERT_TRUE(back.alpha);
    for (int y = 0; y < 29; ++y)
        for (int x = 0; x < 37; ++x)
            if (is_inside(x, y)) {
                ASSERT_EQ(back.pixel(1, x, y)[15], image.pixel(1, x, y)[15]);
                ASSERT_EQ(back.aovs[1].pixel(x, y)[2], image.aovs[1].pixel(x, y)[2]);
                ASSERT_EQ(*back.alpha->pixel(x, y), *image.alpha->pixel(x, y));
            } else {
                ASSERT_EQ(back.pixel(1, x, y)[15], 0);
                ASSERT_EQ(*back.alpha->pixel(x, y), 0);
            }
    // Other programs see the part alone, in colour, and alpha as A
    const Image part = read_image(folder / "part.exr");
    EXPECT_EQ(part.width, 25);
    EXPECT_EQ(part.height, 16);
    EXPECT_NE(std::find(part.channels.begin(), part.channels.end(), "A"), part.channels.end());
    image.data_window.reset();
    write_spectral_exr(folder / "whole.exr", image, kFloats);
    EXPECT_LT(std::filesystem::file_size(folder / "part.exr"),
              std::filesystem::file_size(folder / "whole.exr") / 2);
    EXPECT_FALSE(read_spectral_exr(folder / "whole.exr").data_window);
    EXPECT_TRUE(same_bits(read_spectral_exr(folder / "whole.exr").alpha->data, image.alpha->data));
}

// Names and attributes that programs for mattes look for; ids must not be rounded.
TEST(SpectralFile, CryptomattesKeepTheirNamesAndBits) {
    const test::Folder folder;
    SpectralImage image = some_transport();
    image.aov_names.push_back("CryptoObject");
    image.aovs.push_back(Image::make(37, 29, {"CryptoObject00.R", "CryptoObject00.G"}));
    image.aovs.back().data[4] = 6.07056271e-17f;
    image.aovs.back().data[5] = 1;
    image.metadata["cryptomatte/abc1234/name"] = "CryptoObject";
    write_spectral_exr(folder / "ids.exr", image);
    const SpectralImage back = read_spectral_exr(folder / "ids.exr");
    EXPECT_TRUE(same_bits(back.aovs[2].data, image.aovs[2].data));
    EXPECT_TRUE(same_bits(back.aovs[1].data, image.aovs[1].data));
    EXPECT_EQ(back.metadata, image.metadata);
    EXPECT_NE(back.transport, image.transport) << "half";
    const std::string bytes = read_file(folder / "ids.exr");
    EXPECT_NE(bytes.find("CryptoObject00.R"), std::string::npos);
    EXPECT_NE(bytes.find(std::string("cryptomatte/abc1234/name") + '\0'), std::string::npos);
}

TEST(SpectralFile, RoundTripOfOddBasis) {
    const test::Folder folder;
    for (const SpectralBasis &basis : {SpectralBasis{32, 400, 700}, SpectralBasis{1, 500, 600},
                                       SpectralBasis{7, 380.25, 1e3 / 1.3}}) {
        SpectralImage image = SpectralImage::make(3, 2, basis, {"key"});
        for (std::size_t i = 0; i < image.transport.size(); ++i)
            image.transport[i] = static_cast<float>(i);
        write_spectral_exr(folder / "t.exr", image, kFloats);
        const SpectralImage back = read_spectral_exr(folder / "t.exr");
        EXPECT_EQ(back.basis, basis);
        EXPECT_EQ(back.transport, image.transport);
    }
}

TEST(SpectralFile, HalfIsNear) {
    const test::Folder folder;
    const SpectralImage image = some_transport();
    write_spectral_exr(folder / "h.exr", image);
    const SpectralImage back = read_spectral_exr(folder / "h.exr");
    bool rounded = false;
    for (std::size_t i = 0; i < image.transport.size(); ++i) {
        ASSERT_NEAR(back.transport[i], image.transport[i],
                    std::abs(image.transport[i]) / 2048 + 1e-7f);
        rounded = rounded || back.transport[i] != image.transport[i];
    }
    EXPECT_TRUE(rounded);
}

TEST(SpectralFile, RoundedAsWrittenIsWhatIsRead) {
    const test::Folder folder;
    SpectralImage image = some_transport();
    image.alpha = ramp(37, 29, {"A"});
    for (std::size_t i = 0; i < 400; ++i) // also below the least normal half, and ties
        image.transport[i] =
            std::ldexp(1.0f + 0.00048828125f * static_cast<float>(i % 9), -static_cast<int>(i / 8));
    write_spectral_exr(folder / "h.exr", image);
    const SpectralImage back = read_spectral_exr(folder / "h.exr");
    EXPECT_FALSE(same_bits(back.transport, image.transport));
    SpectralImage floats = image;
    round_as_written(floats, SampleType::float32);
    EXPECT_TRUE(same_bits(floats.transport, image.transport));
    round_as_written(image, SampleType::half);
    EXPECT_EQ(back.transport, image.transport);
    EXPECT_EQ(back.alpha->data, image.alpha->data);
}

TEST(SpectralFile, ChannelsHaveLayoutNames) {
    const auto names = channel_names({.count = 32}, false);
    EXPECT_EQ(names[0], "T.400,000nm");
    EXPECT_EQ(names[1], "T.409,677nm");
    EXPECT_EQ(channel_names({.count = 2}, false, true)[1], "S0.700,000nm");
    EXPECT_EQ(channel_names({.count = 16}, true)[15], "T.depth.15");
}

TEST(SpectralFile, RefusesWrongFiles) {
    const test::Folder folder;
    const auto absent = folder / "absent.exr";
    test::expect_problem([&] { read_spectral_exr(absent); }, absent.string(), "no such file");
    const auto text = folder.write("text.exr", "silk");
    test::expect_problem([&] { read_spectral_exr(text); }, text.string(), "cannot read");
    const auto png = folder / "p.png";
    write_png(png, ramp(8, 8, {"R", "G", "B"}));
    test::expect_problem([&] { read_spectral_exr(png); }, png.string(), "no spectral picture");
    const auto plain = folder / "plain.exr";
    write_exr(plain, ramp(8, 8, {"R", "G", "B"}));
    test::expect_problem([&] { read_spectral_exr(plain); }, plain.string(), "no spectral picture");
    const auto nowhere = folder / "no/where.exr";
    test::expect_problem([&] { write_spectral_exr(nowhere, some_transport()); }, nowhere.string(),
                         "folder");
}

TEST(SpectralFile, RefusesDamagedFiles) {
    const test::Folder folder;
    const auto whole = folder / "whole.exr";
    write_spectral_exr(whole, some_transport());
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(in)), {});
    for (const double part : {0.02, 0.3, 0.6, 0.99}) {
        const auto cut = folder.write(
            "cut.exr",
            bytes.substr(0, static_cast<std::size_t>(part * static_cast<double>(bytes.size()))));
        test::expect_problem([&] { read_spectral_exr(cut); }, cut.string(), "cannot read");
    }
    const auto replaced = [&](const std::string &from, const std::string &to) {
        std::string changed = bytes;
        for (std::size_t at = 0; (at = changed.find(from, at)) != std::string::npos;
             at += to.size())
            changed.replace(at, from.size(), to);
        return folder.write("changed.exr", changed);
    };
    auto path = replaced("T.420,000nm", "T.421,000nm");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(),
                         "the channel 'T.420,000nm' is missing");
    path = replaced("transport.key", "transport.kei");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(),
                         "the part 'transport.key' is missing");
    path = replaced("tsuya-spectral-2", "tsuya-spectral-9");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya-spectral-9");
    path = replaced("hat 16 ", "hat -1 ");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya:basis");
    path = replaced("tsuya:group.0", "tsuya:grove.0");
    test::expect_problem([&] { read_spectral_exr(path); }, path.string(), "tsuya:group.0");
}

TEST(SpectralFile, RefusesWrongPictures) {
    const test::Folder folder;
    const auto exr = folder / "t.exr";
    SpectralImage image = some_transport();
    image.transport.pop_back();
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "values");
    image = some_transport();
    image.aovs[0].width = 36;
    EXPECT_THROW(write_spectral_exr(exr, image), Error);
    image = some_transport();
    image.aov_names.pop_back();
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "given with");
    image = some_transport();
    image.groups[1] = "key";
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "two light groups");
    image.groups[1] = "";
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "no name");
    image = some_transport();
    image.alpha = ramp(37, 28, {"A"});
    test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "alpha");
    image = some_transport();
    for (const std::array<int, 4> &window :
         {std::array{0, 0, 38, 29}, {-1, 0, 37, 29}, {5, 5, 5, 9}, {0, 9, 37, 3}}) {
        image.data_window = window;
        test::expect_problem([&] { write_spectral_exr(exr, image); }, exr.string(), "data window");
    }
    EXPECT_EQ(folder.size(), 0);
}

} // namespace
} // namespace tsuya

#include "tsuya/color/print_file.h"

#include <filesystem>
#include <limits>

#include <sys/resource.h>

#include <gtest/gtest.h>

#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/observer.h"
#include "tsuya/color/srgb.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

namespace fs = std::filesystem;

struct PrintFile : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("tsuya-print-" + std::to_string(getpid()));
    PrintFile() { fs::create_directories(folder); }
    ~PrintFile() override { fs::remove_all(folder); }

    fs::path png(const Image &image, int bits = 8) const {
        write_png(folder / "a.png", image, bits);
        return folder / "a.png";
    }
};

using Bytes = std::vector<std::uint8_t>;

TEST_F(PrintFile, ArtworkIsRgbAsTheFileHasIt) {
    Image image = Image::make(2, 1, {"R", "G", "B"});
    image.data = {1, 0, 0.2f, 0.4f, 0.6f, 1};
    const Texture colour = read_artwork(png(image));
    EXPECT_EQ(colour.channels, 3);
    EXPECT_EQ(colour.data, (Bytes{255, 0, 51, 102, 153, 255}));
    EXPECT_EQ(read_artwork(png(image, 16)).data, colour.data);
    Image grey = Image::make(2, 1, {"Y"});
    grey.data = {0.2f, 1};
    EXPECT_EQ(read_artwork(png(grey)).data, (Bytes{51, 51, 51, 255, 255, 255}));
    // Linear
    Image exr = Image::make(1, 1, {"R", "G", "B"});
    exr.data = {0.5f, 0, 2};
    write_exr(folder / "a.exr", exr);
    EXPECT_EQ(read_artwork(folder / "a.exr").data, (Bytes{188, 0, 255}));
}

TEST_F(PrintFile, AlphaIsCoverageAndLeavesColoursAlone) {
    Image image = Image::make(1, 1, {"R", "G", "B", "A"});
    image.data = {1, 0, 1, 0.6f};
    const Texture texture = read_artwork(png(image));
    EXPECT_EQ(texture.channels, 4);
    EXPECT_EQ(texture.data, (Bytes{255, 0, 255, 153}));
    EXPECT_EQ(read_coverage(folder / "a.png").data, (Bytes{153}));
}

TEST_F(PrintFile, CoverageIsGreyWhereThereIsNoAlpha) {
    Image image = Image::make(1, 1, {"R", "G", "B"});
    image.data = {1, 0, 0.2f};
    const Texture texture = read_coverage(png(image));
    EXPECT_EQ(texture.channels, 1);
    EXPECT_EQ(texture.data, (Bytes{102}));
    EXPECT_THROW(read_artwork(folder / "none.png"), Error);
}

// Floats are linear: half a coverage is half of 255, whatever curve the code of a colour has.
TEST_F(PrintFile, FloatsAreCoverageAsTheyAre) {
    Image exr = Image::make(4, 1, {"Y"});
    exr.data = {0.5f, 0, 1, 2};
    write_exr(folder / "a.exr", exr);
    EXPECT_EQ(read_coverage(folder / "a.exr").data, (Bytes{128, 0, 255, 255}));
    exr.data[2] = std::numeric_limits<float>::quiet_NaN();
    write_exr(folder / "a.exr", exr);
    for (const auto read : {read_coverage, read_artwork}) {
        try {
            read(folder / "a.exr");
            ADD_FAILURE() << "no error";
        } catch (const Error &error) {
            EXPECT_EQ(error.problems()[0].where, (folder / "a.exr").string());
            EXPECT_EQ(error.problems()[0].what, "the pixel at column 2, row 0 is not a number");
        }
    }
}

// A mixture of the inks has the colour that is asked for, and is a reflectance.
TEST_F(PrintFile, MixturesOfInksHaveTheirColour) {
    const std::vector<Spectrum> inks = rgb_inks();
    ASSERT_EQ(inks.size(), 8u);
    const Spectrum d65 = lamp("D65");
    for (const glm::dvec3 &rgb : {glm::dvec3(0.2, 0.5, 0.7), glm::dvec3(0.9, 0.1, 0.05),
                                  glm::dvec3(0.02, 0.02, 0.3), glm::dvec3(0.6)}) {
        Spectrum mixture{{}, {}};
        for (int nm = 380; nm <= 730; nm += 10) {
            double r = 0;
            for (int corner = 0; corner < 8; ++corner) {
                double share = 1;
                for (int c = 0; c < 3; ++c)
                    share *= (corner >> c) & 1 ? rgb[c] : 1 - rgb[c];
                r += share * inks[static_cast<std::size_t>(corner)].at(nm);
            }
            EXPECT_GE(r, 0);
            EXPECT_LE(r, 1);
            mixture.wavelength_nm.push_back(nm);
            mixture.value.push_back(r);
        }
        const glm::dvec3 found =
            srgb_from_xyz() * (xyz_of(d65, mixture) / white_of(d65) * srgb_white());
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(found[c], rgb[c], 0.01) << c;
    }
}

} // namespace
} // namespace tsuya

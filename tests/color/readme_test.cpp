/// \file
/// The example of color/README.md, which is cut from here.

#include <gtest/gtest.h>

#include "color_test.h"
#include "tsuya/color/dye.h"

// [doc:color_example]
#include "tsuya/color/config.h"
#include "tsuya/color/image_file.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/relight.h"

// One render, a picture under each lamp.
void pictures_under(const std::filesystem::path &transport_exr,
                    const std::vector<std::string> &lamps, const std::filesystem::path &folder) {
    const tsuya::SpectralImage transport = tsuya::read_spectral_exr(transport_exr);
    for (const std::string &name : lamps) {
        const tsuya::Spectrum lamp = tsuya::parse_lamp(name);
        const tsuya::Image xyz = tsuya::relight(transport, lamp);
        const tsuya::Image rgb = tsuya::display(
            xyz, tsuya::white_of(lamp), {.adapt = tsuya::Adaptation::cat02, .view = "Soft"});
        tsuya::write_png(folder / (name + ".png"), rgb);
    }
}
// [/doc:color_example]

namespace tsuya {
namespace {

TEST(Readme, ExampleRuns) {
    const test::Folder folder;
    SpectralImage image = SpectralImage::make(8, 6, {.count = 8}, {"key"});
    const std::vector<float> crimson = project(dye("crimson"), image.basis);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x)
            std::copy(crimson.begin(), crimson.end(), image.pixel(0, x, y));
    write_spectral_exr(folder / "dress.exr", image);
    pictures_under(folder / "dress.exr", {"D65", "HP4", "A"}, folder / "");
    EXPECT_EQ(folder.size(), 4);
    const Image day = read_image(folder / "D65.png"), lamp_a = read_image(folder / "A.png");
    EXPECT_GT(day.data[0], 2 * day.data[1]); // crimson is red
    EXPECT_NE(day.data, lamp_a.data);
}

} // namespace
} // namespace tsuya

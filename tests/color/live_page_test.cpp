#include "tsuya/color/live_page.h"

#include <array>
#include <cmath>
#include <limits>

#include "color/color_test.h"
#include "page/json_text.h"
#include "page/packed_picture.h"
#include "page/plane_bytes.h"
#include "tsuya/color/dye.h"
#include "tsuya/color/lamp.h"

namespace tsuya {
namespace {

using test::expect_problem;

/// A cloth whose dye is open, in folds of which each sends light on to the next.
SpectralImage cloth(int width = 40, int height = 30) {
    SpectralImage image = SpectralImage::make(width, height, {.count = 8}, {"key", "fill"});
    image.depths = make_dye_depths(
        {{.name = "satin", .dye = dye("crimson"), .open = true, .lowest = 0, .highest = 0.98}}, 8);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int k = 0; k < 8; ++k) {
                const double r = image.depths->node[static_cast<std::size_t>(k)][0];
                const double folds = 0.5 * x / width, gloss = y % 7 == 0 ? 3 : 0.02;
                image.pixel(0, x, y)[k] =
                    static_cast<float>(gloss + 0.9 * r * (1 - folds) / (1 - folds * r));
                image.pixel(1, x, y)[k] = static_cast<float>(0.2 * r * (1 - folds) + 0.01 * gloss);
            }
    return image;
}

PageOptions lit() { return {.lamps = {{"D65", lamp("D65")}, {"A", lamp("A")}}}; }

LivePage page_of(const SpectralImage &image, const PageOptions &options = lit()) {
    const std::array<PageDress, 1> dresses{{{"cloth", image}}};
    return live_page(dresses, options);
}

std::size_t count(const std::string &text, const std::string &part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++found;
    return found;
}

TEST(PlaneBytes, HoldDifferencesFromWhatNeighboursForetell) {
    // 5 from 0; 3 from 5; 4 from 5; and 300 from 3 + 4 - 5, limited to 3..4
    const std::vector<std::uint16_t> codes{5, 3, 4, 300};
    const std::vector<int> folded{10, 3, 1, 594};
    const std::string bytes = plane_bytes(codes, 2);
    ASSERT_EQ(bytes.size(), 8u);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(static_cast<unsigned char>(bytes[i]) +
                      256 * static_cast<unsigned char>(bytes[4 + i]),
                  folded[i])
            << i;
}

TEST(PlaneBytes, Base64IsThatOfTheStandard) { // RFC 4648 section 10
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
    EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

TEST(JsonText, IsSafeInAScript) {
    EXPECT_EQ(json::text("a\"b\\</script>\n"), "\"a\\u0022b\\u005c\\u003c/script>\\u000a\"");
    EXPECT_EQ(json::number(0.1), "0.10000000000000001");
    EXPECT_EQ(json::number(1.0 / 3, 3), "0.333");
}

TEST(PackedPicture, KeepsTheBoundAndGetsFinerWithIt) {
    const SpectralImage image = cloth();
    const PackedPicture coarse = pack_picture(image, {.mean = 0.3, .p99 = 1.2});
    const PackedPicture fine = pack_picture(image, {.mean = 0.03, .p99 = 0.12});
    EXPECT_LE(coarse.error.mean, 0.3);
    EXPECT_LE(fine.error.mean, 0.03);
    EXPECT_LE(fine.error.p99, 0.12);
    EXPECT_LT(fine.error.mean, coarse.error.mean);
    EXPECT_LT(fine.groups[0].planes[0].step, coarse.groups[0].planes[0].step);
    EXPECT_GE(fine.groups[0].planes.size(), coarse.groups[0].planes.size());
    EXPECT_EQ(fine.groups.size(), 2u);
    EXPECT_EQ(fine.groups[0].planes.size(), fine.groups[0].direction.size() + 1);
    // A bound of zero is met by none: the finest there are.
    EXPECT_GT(pack_picture(image, {}).error.mean, 0);
}

TEST(PackedPicture, PixelsThatAreNotFiniteAreBlack) {
    SpectralImage image = cloth();
    image.pixel(0, 3, 2)[1] = std::numeric_limits<float>::quiet_NaN();
    image.pixel(0, 4, 2)[0] = std::numeric_limits<float>::infinity();
    const PackedPicture packed = pack_picture(image, {.mean = 0.1, .p99 = 0.4});
    EXPECT_LE(packed.error.mean, 0.1);
    const auto level = [&](int x) {
        return packed.groups[0].planes[0].codes[static_cast<std::size_t>(2 * image.width + x)];
    };
    EXPECT_EQ(level(3), 0);
    EXPECT_EQ(level(4), 0);
    EXPECT_GT(level(5), 0);
}

TEST(PackedPicture, ABlackPictureIsBlack) {
    SpectralImage image = SpectralImage::make(4, 3, {}, {"key"});
    const PackedPicture packed = pack_picture(image, {.mean = 0.1, .p99 = 0.4});
    EXPECT_EQ(packed.error.mean, 0);
    for (const std::uint16_t code : packed.groups[0].planes[0].codes)
        EXPECT_EQ(code, 0);
}

TEST(LivePage, IsOneFileThatNeedsNoOther) {
    PageOptions options = lit();
    options.title = "Silk </title> & \"satin\"";
    options.dyes = {{"</script>mine", Spectrum::constant(0.5)}};
    const LivePage made = page_of(cloth(), options);
    EXPECT_NE(made.html.find("<title>Silk &lt;/title> &amp; \"satin\"</title>"), std::string::npos);
    EXPECT_EQ(count(made.html, "http"), 0u);
    EXPECT_EQ(count(made.html, "src="), 0u);
    EXPECT_EQ(count(made.html, "@import"), 0u);
    EXPECT_EQ(count(made.html, "<link"), 0u);
    EXPECT_EQ(count(made.html, "{{"), 0u);
    EXPECT_EQ(count(made.html, "<script"), count(made.html, "</script>"));
    EXPECT_NE(made.html.find("id=\"planes-0\""), std::string::npos);
    ASSERT_EQ(made.errors.size(), 1u);
    EXPECT_GT(made.errors[0].mean, 0);
    EXPECT_LE(made.errors[0].mean, PageOptions{}.most_error.mean);
    EXPECT_EQ(page_of(cloth(), options).html, made.html);
}

TEST(LivePage, RefusesWhatItCannotShow) {
    expect_problem([] { live_page({}, lit()); }, "dresses", "no picture");
    expect_problem([] { page_of(cloth(), {}); }, "lamps", "without a lamp");
    SpectralImage cut = cloth();
    cut.transport.pop_back();
    expect_problem([&] { page_of(cut); }, "dresses.0", "19199 numbers");
    expect_problem([] { page_of(SpectralImage::make(4, 4, {}, {})); }, "dresses.0", "0 numbers");
    SpectralImage undetermined = cloth();
    undetermined.depths->node[1] = undetermined.depths->node[0];
    expect_problem([&] { page_of(undetermined); }, "dresses.0", "do not fit");
    SpectralImage other = cloth();
    other.depths = make_dye_depths(other.depths->dyes, 7);
    expect_problem([&] { page_of(other); }, "dresses.0", "8 channels for 7 depths");
    PageOptions twice = lit();
    twice.lamps[1].name = "D65";
    expect_problem([&] { page_of(cloth(), twice); }, "lamps.1", "used twice");
    PageOptions dark = lit();
    dark.lamps[1].spectrum = Spectrum::constant(0);
    expect_problem([&] { page_of(cloth(), dark); }, "lamp", "no visible power");
    PageOptions dyed = lit();
    dyed.dyes = {{"x", Spectrum::constant(1.5)}};
    expect_problem([&] { page_of(cloth(), dyed); }, "dyes.x", "1.5");
    PageOptions view = lit();
    view.look.view = "Hard";
    expect_problem([&] { page_of(cloth(), view); }, "view", "Hard");
    PageOptions exposed = lit();
    exposed.look.exposure_stops = std::numeric_limits<double>::infinity();
    expect_problem([&] { page_of(cloth(), exposed); }, "exposure", "not finite");
}

} // namespace
} // namespace tsuya

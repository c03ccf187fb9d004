#include "tsuya/scene/picture.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/sheet.h"
#include "tsuya/color/srgb.h"
#include "tsuya/scene/aov_picture.h"
#include "tsuya/scene/exposure.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/error.h"

namespace tsuya::scene {
namespace {

namespace fs = std::filesystem;
using Texts = std::vector<std::string>;

/// The problem that a call must raise.
template <class Call> Problem problem_of(Call &&call) {
    try {
        call();
    } catch (const Error &error) {
        return error.problems()[0];
    }
    ADD_FAILURE() << "no error was thrown";
    return {"", "", ""};
}

TEST(Lamps, AreNamedAfterTheirFiles) {
    const Scratch scratch;
    scratch.write("shop.csv", "wavelength_nm,value\n400,1\n700,2\n");
    const std::vector<NamedLamp> lamps = parse_lamps(Texts{"D65", "shop.csv"}, scratch.folder());
    ASSERT_EQ(lamps.size(), 2u);
    EXPECT_EQ(lamps[1].name, "shop");
    EXPECT_EQ(lamps[1].caption.find("shop.csv: "), 0u) << lamps[1].caption;
    EXPECT_NE(lamps[0].caption.find("6504 K"), std::string::npos);
    EXPECT_NE(problem_of([] {
                  parse_lamps(Texts{"A", "A"});
              }).what.find("two lamps"),
              std::string::npos);
    EXPECT_EQ(problem_of([] { parse_lamps(Texts{}); }).where, "lamps");
}

TEST(Lamps, SetsStandForSeveral) {
    const std::vector<NamedLamp> lamps = parse_lamps(Texts{"lightbox-europe", "HP4"});
    ASSERT_EQ(lamps.size(), 4u);
    EXPECT_EQ(lamps[1].name, "TL84");
    EXPECT_EQ(lamps[1].caption, "TL84: three-band fluorescent, 4000 K, as FL11");
    EXPECT_NE(problem_of([] {
                  check_lamps(Texts{"A", "lightbox-europe"});
              }).what.find("two lamps"),
              std::string::npos);
}

TEST(Lamps, FactorsScaleTheirGroups) {
    SpectralImage image = SpectralImage::make(1, 1, {}, {"key", "fill"});
    std::fill(image.transport.begin(), image.transport.end(), 0.1f);
    const auto grey = [&](const Texts &specs) {
        const DisplayOptions plain{.adapt = Adaptation::cat02, .view = "Plain"};
        const Image rgb = picture_under(image, parse_group_lamps(specs, image.groups), plain);
        return srgb_decode(static_cast<double>(*rgb.pixel(0, 0)));
    };
    EXPECT_NEAR(grey({"D65"}), 0.2, 1e-4);
    EXPECT_NEAR(grey({"0.5*D65"}), 0.1, 1e-4);
    EXPECT_NEAR(grey({"key=D65*3", "fill=500lx*D65"}), 0.35, 1e-4);
    EXPECT_NEAR(grey({"key=0*D65", "fill=D65"}), 0.1, 1e-4);
}

/// An even picture of a dye with a garment in its middle.
SpectralImage even_picture(double garment, double around) {
    SpectralImage image = SpectralImage::make(20, 10, {.count = 8}, {"key"});
    image.aov_names = {"garment"};
    image.aovs = {Image::make(20, 10, {"A"})};
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 20; ++x) {
            const bool covered = x >= 5 && x < 15;
            *image.aovs[0].pixel(x, y) = covered ? 1.0f : (x == 4 ? 0.5f : 0.0f);
            std::fill_n(image.pixel(0, x, y), 8, static_cast<float>(covered ? garment : around));
        }
    return image;
}

/// Codes of 255 of the green channel.
std::vector<double> codes_of(const SpectralImage &image, const std::vector<NamedLamp> &lamp,
                             DisplayOptions look, double stops) {
    look.exposure_stops = stops;
    const Image picture = picture_under(image, lamp, look);
    std::vector<double> codes;
    for (std::size_t i = 1; i < picture.data.size(); i += picture.channels.size())
        codes.push_back(255 * static_cast<double>(picture.data[i]));
    return codes;
}

TEST(Exposure, AnEvenGarmentShowsAt235InEachView) {
    const std::vector<NamedLamp> d65 = parse_lamps(Texts{"D65"});
    for (const std::string view : {"Plain", "Soft"})
        for (const double value : {0.02, 0.3, 4.0}) {
            const DisplayOptions look{.view = view};
            // A bright wall and pixels that show little of the garment do not count
            const SpectralImage image = even_picture(value, 50);
            ExposureMeter meter(look);
            meter.add(image, d65);
            const std::vector<double> codes = codes_of(image, d65, look, meter.stops());
            EXPECT_NEAR(codes[10], 235, 1) << view << value;
        }
}

TEST(Exposure, TheBrightestOfAJobDecides) {
    const std::vector<NamedLamp> lamps = parse_lamps(Texts{"D65", "A"});
    ExposureMeter both(DisplayOptions{}), white(DisplayOptions{});
    for (const NamedLamp &lamp : lamps) {
        both.add(even_picture(0.04, 1), {&lamp, 1});
        both.add(even_picture(0.8, 1), {&lamp, 1});
        white.add(even_picture(0.8, 1), {&lamp, 1});
    }
    EXPECT_EQ(both.stops(), white.stops());
    EXPECT_EQ(ExposureMeter(DisplayOptions{}).stops(), 0);
    EXPECT_THROW(ExposureMeter(DisplayOptions{.view = "soft"}), Error);
}

// Highlights on a tenth of the garment, and on too little of it to count.
TEST(Exposure, ClipsAtMostAHundredth) {
    const std::vector<NamedLamp> d65 = parse_lamps(Texts{"D65"});
    const auto clipped = [&](int highlights) {
        SpectralImage image = even_picture(0.3, 0);
        for (int i = 0; i < highlights; ++i)
            std::fill_n(image.pixel(0, 5 + i % 10, i / 10), 8, 6.0f);
        ExposureMeter meter(DisplayOptions{});
        meter.add(image, d65);
        const std::vector<double> codes = codes_of(image, d65, {}, meter.stops());
        return std::pair(
            std::count_if(codes.begin(), codes.end(), [](double c) { return c > 254.6; }),
            codes[199 - 5]);
    };
    EXPECT_EQ(clipped(10).first, 0);
    EXPECT_LT(clipped(10).second, 80);
    EXPECT_EQ(clipped(1).first, 1); // of 100
    EXPECT_NEAR(clipped(1).second, 235, 1);
}

TEST(PictureUnder, HasAlphaWhereTheTransportHas) {
    const std::vector<NamedLamp> d65 = parse_lamps(Texts{"D65"});
    SpectralImage image = even_picture(0.5, 0);
    const Image opaque = picture_under(image, d65, {});
    EXPECT_EQ(opaque.channels.size(), 3u);
    image.alpha = Image::make(20, 10, {"A"});
    for (int y = 0; y < 10; ++y)
        for (int x = 5; x < 15; ++x) {
            *image.alpha->pixel(x, y) = 0.25f;
            for (int k = 0; k < 8; ++k)
                image.pixel(0, x, y)[k] *= 0.25f;
        }
    const Image picture = picture_under(image, d65, {});
    EXPECT_EQ(picture.channels, (Texts{"R", "G", "B", "A"}));
    EXPECT_EQ(picture.pixel(7, 5)[3], 0.25f);
    EXPECT_NEAR(picture.pixel(7, 5)[1], opaque.pixel(7, 5)[1], 1e-5);
    EXPECT_EQ(picture.pixel(0, 0)[3], 0);
    // On a sheet it lies on the ground
    const Image sheet = draw_sheet({.pictures = {{picture, ""}}});
    const float ground = sheet.pixel(0, 0)[1];
    const int left = sheet.width - 20 - 8, top = sheet.height - 10 - 8;
    EXPECT_NEAR(sheet.pixel(left + 7, top + 5)[1], 0.75f * ground + 0.25f * picture.pixel(7, 5)[1],
                1e-5);
}

TEST(AovPicture, ShowsEachKind) {
    SpectralImage image = even_picture(0.5, 0);
    const NamedLamp d65 = parse_lamps(Texts{"D65"})[0];
    image.aov_names = {"depth", "normal", "direct", "albedo", "CryptoObject", "uv"};
    const Texts albedo = channel_names(image.basis, false);
    Texts direct = albedo;
    for (std::string &name : direct)
        name.insert(0, "key.");
    image.aovs.clear();
    for (const Texts &channels : {Texts{"Z"}, Texts{"X", "Y", "Z"}, direct, albedo,
                                  Texts{"CryptoObject00.R", "CryptoObject00.G"}, Texts{"U", "V"}})
        image.aovs.push_back(Image::make(20, 10, channels));
    const auto set = [&](std::size_t aov, std::vector<float> values) {
        std::copy(values.begin(), values.end(), image.aovs[aov].pixel(3, 2));
    };
    const auto shown = [&](std::size_t aov) { return aov_picture(image, aov, d65, {}); };
    std::fill(image.aovs[0].data.begin(), image.aovs[0].data.end(), 4.0f);
    set(0, {2});
    EXPECT_EQ(shown(0).pixel(3, 2)[0], 1);
    EXPECT_EQ(shown(0).pixel(0, 0)[0], 0);
    set(1, {1, 0, -1});
    EXPECT_EQ(shown(1).pixel(3, 2)[0], 1);
    EXPECT_EQ(shown(1).pixel(3, 2)[1], 0.5f);
    EXPECT_EQ(shown(1).pixel(3, 2)[2], 0);
    EXPECT_EQ(shown(1).pixel(0, 0)[1], 0) << "nothing is black";
    for (const std::size_t aov : {2, 3}) {
        set(aov, std::vector<float>(8, 0.5f));
        EXPECT_NEAR(shown(aov).pixel(3, 2)[1], 0.735f, 0.002f) << "sRGB of 0.5";
    }
    set(4, {6.07e-17f, 0.5f});
    const float *const half = shown(4).pixel(3, 2);
    EXPECT_GT(half[0] + half[1] + half[2], 0.3f);
    EXPECT_LT(std::max({half[0], half[1], half[2]}), 0.51f);
    set(5, {0.32f, -0.01f});
    EXPECT_NEAR(shown(5).pixel(3, 2)[0], 0.2f, 1e-5);
    EXPECT_NEAR(shown(5).pixel(3, 2)[1], 0.9f, 1e-5);
    EXPECT_EQ(problem_of([&] { aov_picture(image, 6, d65); }).where, "aov");
}

TEST(Lamps, OfGroups) {
    const Texts groups{"key", "fill"};
    const auto names = [&](const Texts &specs) {
        Texts result;
        for (const NamedLamp &lamp : parse_group_lamps(specs, groups))
            result.push_back(lamp.name);
        return result;
    };
    EXPECT_EQ(names({"A"}), (Texts{"A", "A"}));
    EXPECT_EQ(names({"fill=A", "D65"}), (Texts{"D65", "A"}));
    EXPECT_EQ(names({"key=A", "fill=D65"}), (Texts{"A", "D65"}));
    EXPECT_NE(problem_of([&] { names({"kei=A"}); }).accepted.find("key"), std::string::npos);
    EXPECT_NE(problem_of([&] { names({"key=A"}); }).what.find("fill"), std::string::npos);
    EXPECT_NE(problem_of([&] { names({"A", "D65"}); }).what.find("two lamps"), std::string::npos);
    EXPECT_NE(problem_of([&] {
                  names({"key=A", "key=A"});
              }).what.find("two lamps"),
              std::string::npos);
}

TEST(Picture, OfAWhiteIsNeutralUnderDaylight) {
    SpectralImage image = SpectralImage::make(2, 1, {.count = 8}, {"key"});
    std::fill_n(image.pixel(0, 0, 0), 8, 0.18f);
    const NamedLamp daylight{"D65", lamp("D65")}, incandescent{"A", lamp("A")};
    const Image picture = picture_under(image, {&daylight, 1});
    EXPECT_NEAR(picture.pixel(0, 0)[0], 0.461, 0.01); // sRGB of 0.18
    EXPECT_NEAR(picture.pixel(0, 0)[0], picture.pixel(0, 0)[2], 0.005);
    EXPECT_NEAR(picture.pixel(1, 0)[0], 0, 1e-6);
    const Image warm = picture_under(image, {&incandescent, 1});
    EXPECT_GT(warm.pixel(0, 0)[0], warm.pixel(0, 0)[2] + 0.2f);
    const Image adapted =
        picture_under(image, {&incandescent, 1}, {.adapt = Adaptation::cat02, .view = "Soft"});
    EXPECT_NEAR(adapted.pixel(0, 0)[0], adapted.pixel(0, 0)[2], 0.01);
}

TEST(FileStem, IsFitForAFileName) {
    EXPECT_EQ(file_stem_of("crimson"), "crimson");
    EXPECT_EQ(file_stem_of("my/own.CSV"), "own");
    EXPECT_EQ(file_stem_of("my/own.csv:navy"), "own_navy");
    EXPECT_EQ(file_stem_of("#aabbcc"), "aabbcc");
    EXPECT_EQ(file_stem_of("0.7*A + 0.3*D65"), "0.7A_+_0.3D65");
    EXPECT_EQ(file_stem_of("a/b").find('/'), std::string::npos);
    for (const char *const spec : {"my/own.csv:navy blue", "0.5*A", "0.5*my/a.csv", "#aabbcc"})
        EXPECT_EQ(file_stem_of(label_of(spec)), file_stem_of(spec));
}

TEST(Label, IsAsItIsWrittenWithoutFolders) {
    EXPECT_EQ(label_of("#aabbcc"), "#aabbcc");
    EXPECT_EQ(label_of("0.5*A"), "0.5*A");
    EXPECT_EQ(label_of("indigo 2% + madder 0.5%"), "indigo 2% + madder 0.5%");
    EXPECT_EQ(label_of("my/own.csv"), "own");
    EXPECT_EQ(label_of("my/own.csv:navy"), "own:navy");
    EXPECT_EQ(parse_lamps(Texts{"0.5*A"})[0].name, "0.5*A");
}

TEST(Distinct, CasesDoNotPartNames) {
    check_distinct(Texts{"crimson", "#aabbcc", "a.csv:x", "a.csv:y"}, "dye");
    for (const Texts &two :
         {Texts{"CRIMSON", "crimson"}, Texts{"#AABBCC", "#aabbcc"}, Texts{"a/x.csv", "b/X.csv"}}) {
        const Problem problem = problem_of([&] { check_distinct(two, "dye"); });
        EXPECT_EQ(problem.where, "dye");
        EXPECT_NE(problem.what.find("two dyes"), std::string::npos) << problem.what;
    }
    EXPECT_NE(problem_of([] {
                  check_lamps(Texts{"d65", "D65"});
              }).what.find("two lamps"),
              std::string::npos);
}

TEST(OutputFile, CreatesItsFolderAndNothingElse) {
    const Scratch scratch;
    prepare_output_file(scratch / "a/b/c.exr", {".exr"});
    EXPECT_TRUE(fs::is_directory(scratch / "a/b"));
    EXPECT_EQ(scratch.file_count(), 0u);
}

TEST(OutputFile, RefusesBeforeItCreatesAnything) {
    const Scratch scratch;
    fs::create_directories(scratch / "folder.exr");
    scratch.write("file", "text");
    const auto refused = [&](const std::string &name) {
        return problem_of([&] { prepare_output_file(scratch / name, {".exr"}); });
    };
    EXPECT_NE(refused("folder.exr").what.find("folder"), std::string::npos);
    EXPECT_NE(refused("new/a.png").accepted.find(".exr"), std::string::npos);
    EXPECT_NE(refused("new/a").what.find("extension"), std::string::npos);
    EXPECT_FALSE(fs::exists(scratch / "new"));
    EXPECT_EQ(refused("file/a.exr").where, (scratch / "file").string());
    EXPECT_EQ(problem_of([&] { const OutputFolder folder(scratch / "file"); }).where,
              (scratch / "file").string());
}

TEST(OutputFolder, IsRemovedAgainWhereItGotNothing) {
    const Scratch scratch;
    const fs::path mine = scratch / "mine", deep = mine / "a/b/";
    fs::create_directories(mine);
    { const OutputFolder folder(deep); }
    EXPECT_TRUE(fs::is_empty(mine));
    {
        const OutputFolder folder(deep);
        EXPECT_TRUE(fs::is_directory(deep));
        scratch.write("mine/a/b/result", "x");
    }
    EXPECT_TRUE(fs::exists(deep / "result"));
    { const OutputFolder folder(scratch / "mine/c"); }
    EXPECT_FALSE(fs::exists(mine / "c"));
    fs::create_directories(mine / "c");
    { const OutputFolder folder(mine / "c"); }
    EXPECT_TRUE(fs::is_directory(mine / "c")) << "it was there before";
}

} // namespace
} // namespace tsuya::scene

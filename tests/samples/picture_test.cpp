#include "tsuya/scene/picture.h"

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/color/lamp.h"
#include "tsuya/color/srgb.h"
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

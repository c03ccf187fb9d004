#include "tsuya/color/camera_frame.h"

#include <algorithm>
#include <cmath>

#include "color_test.h"
#include "tsuya/color/image_file.h"

namespace tsuya {
namespace {

/// A number for each pixel that no other pixel near it has.
float dn_at(int x, int y) { return static_cast<float>((7919 * y + 31 * x) % 16384); }

CameraFrame sensor(int width, int height, std::vector<std::string> channels = {"Y"}) {
    CameraFrame frame{.image = Image::make(width, height, channels),
                      .exposure_s = 0.125,
                      .f_number = 8,
                      .iso = 200,
                      .time = "2026:03:01 12:00:05"};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (std::size_t c = 0; c < channels.size(); ++c)
                frame.image.pixel(x, y)[c] = dn_at(x, y) + static_cast<float>(c);
    return frame;
}

TEST(CameraFrame, TiffGivesTheNumbersOfTheArea) {
    const test::Folder folder;
    write_frame(folder / "f.tif", sensor(200, 150));
    const CameraFrame frame = read_frame(folder / "f.tif", {.area = PixelArea{90, 61, 32, 16}});
    EXPECT_EQ(frame.width, 200);
    EXPECT_EQ(frame.height, 150);
    ASSERT_EQ(frame.image.width, 32);
    ASSERT_EQ(frame.image.height, 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 32; ++x)
            ASSERT_EQ(frame.image.pixel(x, y)[0], dn_at(90 + x, 61 + y)) << x << ", " << y;
    ASSERT_TRUE(frame.exposure_s && frame.f_number);
    EXPECT_NEAR(*frame.exposure_s, 0.125, 1e-6);
    EXPECT_NEAR(*frame.f_number, 8, 1e-6);
    EXPECT_FALSE(frame.iso) << "OpenImageIO does not read it from a TIFF";
    EXPECT_EQ(frame.time, "2026:03:01 12:00:05");
    EXPECT_EQ(frame.cfa, "");
}

TEST(CameraFrame, ColoursStayApart) {
    const test::Folder folder;
    write_frame(folder / "f.tif", sensor(20, 10, {"R", "G", "B"}));
    const CameraFrame frame = read_frame(folder / "f.tif");
    EXPECT_EQ(frame.image.channels, (std::vector<std::string>{"R", "G", "B"}));
    EXPECT_EQ(frame.image.pixel(3, 4)[2], dn_at(3, 4) + 2);
}

TEST(CameraFrame, RawIsNeitherStretchedNorDemosaiced) {
    const test::Folder folder;
    CameraFrame raw = sensor(96, 64);
    raw.cfa = "RGGB";
    write_frame(folder / "f.dng", raw);
    const CameraFrame frame = read_frame(folder / "f.dng", {.area = PixelArea{41, 20, 8, 6}});
    EXPECT_EQ(frame.width, 96);
    ASSERT_EQ(frame.image.channels.size(), 1u);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x)
            ASSERT_EQ(frame.image.pixel(x, y)[0], dn_at(41 + x, 20 + y)) << x << ", " << y;
    EXPECT_EQ(frame.cfa, "GRBG") << "the area begins at an odd column";
    EXPECT_EQ(read_frame(folder / "f.dng").cfa, "RGGB");
    ASSERT_TRUE(frame.exposure_s && frame.iso);
    EXPECT_NEAR(*frame.exposure_s, 0.125, 1e-6);
    EXPECT_EQ(*frame.iso, 200);
    raw.cfa = "GBRG";
    write_frame(folder / "g.dng", raw);
    EXPECT_EQ(read_frame(folder / "g.dng").cfa, "") << "OpenImageIO does not tell it";
}

TEST(CameraFrame, EncodedPicturesAreRefusedWithoutTheirResponse) {
    const test::Folder folder;
    Image grey = Image::make(4, 4, {"Y"});
    std::fill(grey.data.begin(), grey.data.end(), 0.4f); // 102 of 255
    write_png(folder / "eight.png", grey);
    write_png(folder / "sixteen.png", grey, 16);
    for (const char *name : {"eight.png", "sixteen.png"})
        test::expect_problem([&] { read_frame(folder / name); }, (folder / name).string(),
                             "response curve");

    // A camera whose number is 255 times the root of the light: 102 is .16 of the light of 255.
    ResponseCurve root;
    for (int dn = 1; dn <= 255; ++dn) {
        root.dn.push_back(dn);
        root.exposure_s.push_back(dn * dn / 65025.0);
    }
    const CameraFrame frame = read_frame(folder / "eight.png", {.response = root});
    EXPECT_NEAR(frame.image.pixel(1, 1)[0], 0.16 * 255, 1e-4);
}

TEST(CameraFrame, ResponseIsLinearBetweenItsPointsAndConstantBeyond) {
    const ResponseCurve curve{.dn = {10, 20, 40}, .exposure_s = {1, 3, 8}};
    EXPECT_DOUBLE_EQ(curve.linear_dn(40), 40);
    EXPECT_DOUBLE_EQ(curve.linear_dn(15), 5 * 2);
    EXPECT_DOUBLE_EQ(curve.linear_dn(0), 5 * 1);
    EXPECT_DOUBLE_EQ(curve.linear_dn(1000), 40);
}

TEST(CameraFrame, ResponseFilesAreReadAndTheirFaultsNamed) {
    const test::Folder folder;
    const auto file = folder.write("r.csv", "# grey card\ndn,exposure_s\n10,0.1\n 20 , 0.3 \n");
    const ResponseCurve curve = read_response_csv(file);
    EXPECT_EQ(curve.dn, (std::vector<double>{10, 20}));
    EXPECT_EQ(curve.exposure_s, (std::vector<double>{0.1, 0.3}));
    for (const char *bad : {"10,0.1\n20,0.1\n", "10,0.1\n10,0.2\n", "10,0.1\n20\n",
                            "10,0.1\n20,0.2,3\n", "10,0.1\n20,nan\n"}) {
        folder.write("r.csv", bad);
        test::expect_problem([&] { read_response_csv(file); }, file.string() + ":2:1",
                             "dn,exposure_s");
    }
    folder.write("r.csv", "10,0.1\n");
    test::expect_problem([&] { read_response_csv(file); }, file.string(), "two lines");
}

TEST(CameraFrame, BadFilesAreErrorsAtTheirPath) {
    const test::Folder folder;
    const auto where = [&](const char *name) { return (folder / name).string(); };
    test::expect_problem([&] { read_frame(folder / "none.tif"); }, where("none.tif"),
                         "no such file");
    folder.write("empty.tif", "");
    test::expect_problem([&] { read_frame(folder / "empty.tif"); }, where("empty.tif"),
                         "cannot read");
    write_frame(folder / "f.tif", sensor(200, 150));
    std::filesystem::copy_file(folder / "f.tif", folder / "short.tif");
    std::filesystem::resize_file(folder / "short.tif", 30000);
    test::expect_problem([&] { read_frame(folder / "short.tif"); }, where("short.tif"),
                         "cannot read");
    for (const PixelArea area : {PixelArea{190, 0, 11, 1}, PixelArea{0, -1, 1, 1},
                                 PixelArea{0, 0, 0, 1}, PixelArea{0, 2147483647, 1, 1}})
        test::expect_problem([&] { read_frame(folder / "f.tif", {.area = area}); }, where("f.tif"),
                             "200 x 150");
}

TEST(CameraFrame, WritingRefusesWhatSixteenBitsDoNotHold) {
    const test::Folder folder;
    for (const float dn : {-1.0f, 65536.0f, std::nanf("")}) {
        CameraFrame frame = sensor(2, 2);
        frame.image.data[1] = dn;
        test::expect_problem([&] { write_frame(folder / "f.tif", frame); },
                             (folder / "f.tif").string(), "0 to 65535");
    }
    CameraFrame raw = sensor(2, 2);
    test::expect_problem([&] { write_frame(folder / "f.dng", raw); }, (folder / "f.dng").string(),
                         "NAME.tif");
    for (const char *cfa : {"RGB", "RGGX"}) {
        raw.cfa = cfa;
        test::expect_problem([&] { write_frame(folder / "f.dng", raw); },
                             (folder / "f.dng").string(), "four of R, G, B");
    }
    EXPECT_EQ(folder.size(), 0);
}

} // namespace
} // namespace tsuya

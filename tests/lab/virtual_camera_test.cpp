#include "tsuya/lab/virtual_camera.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "samples/scratch.h"
#include "tsuya/lab/frame_reader.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

using scene::Scratch;

TEST(VirtualCamera, PicturesOfAClippedSampleAreNoCopies) {
    const Scratch folder;
    VirtualCamera camera({}, {.black = 512, .saturation = 15800, .e_per_dn = 2.5});
    std::vector<std::string> bytes;
    for (const std::size_t n : {0, 1}) {
        const Shot shot{.number = n,
                        .planned = {.kind = FrameKind::white, .exposure_s = 100},
                        .file = folder / (std::to_string(n) + ".tif"),
                        .time_s = 1e9 + 200 * static_cast<double>(n)};
        camera.expose(shot);
        camera.collect(shot);
        bytes.push_back(read_file(shot.file));
    }
    EXPECT_NE(bytes[0], bytes[1]);
}

TEST(FrameReader, TellsExposureAndPatch) {
    const Scratch folder;
    CameraFrame frame{.image = Image::make(64, 48, {"Y"}), .exposure_s = 2};
    std::fill(frame.image.data.begin(), frame.image.data.end(), 600.0f);
    for (int y = 16; y < 32; ++y)
        for (int x = 24; x < 40; ++x)
            frame.image.pixel(x, y)[0] = 1000;
    write_frame(folder / "a.tif", frame);
    const RigCamera camera{.black = 500, .patch = 16};
    const FrameFacts facts = read_frame_facts(folder / "a.tif", camera, 0);
    EXPECT_EQ(facts.exposure_s, 2);
    EXPECT_DOUBLE_EQ(facts.patch_mean, 500);
    std::filesystem::resize_file(folder / "a.tif", 3000);
    EXPECT_THROW(read_frame_facts(folder / "a.tif", camera, 0), Error);
}

TEST(VirtualCamera, HasTheFaultsOfARealOne) {
    const Scratch folder;
    const RigCamera camera{.black = 512, .saturation = 15800, .e_per_dn = 2.5, .read_noise_e = 4};
    const std::vector<std::optional<CameraFault>> faults{
        std::nullopt,          CameraFault::busy,     CameraFault::busy,
        CameraFault::hang,     CameraFault::no_file,  CameraFault::empty_file,
        CameraFault::cut_file, CameraFault::old_file, CameraFault::wrong_exposure,
        std::nullopt};
    VirtualCamera virtual_camera({.cloth = [](const DirectionPair &) { return 0.02; }}, camera,
                                 {.fault = [&](std::uint64_t n) { return faults[n]; }});
    const auto take = [&](std::size_t n) {
        const Shot shot{.number = n,
                        .planned = {.exposure_s = 1},
                        .file = folder / (std::to_string(n) + ".tif"),
                        .time_s = 1e9};
        virtual_camera.expose(shot);
        virtual_camera.collect(shot);
        return shot.file;
    };
    const auto first = take(0);
    const FrameFacts good = read_frame_facts(first, camera, 0);
    EXPECT_NEAR(good.patch_mean, virtual_camera.dn_per_s({.exposure_s = 1}, 1e9), 40);
    EXPECT_THROW(take(1), Error);
    EXPECT_THROW(take(2), Error);
    EXPECT_THROW(take(3), Error);
    EXPECT_FALSE(std::filesystem::exists(take(4)));
    EXPECT_EQ(std::filesystem::file_size(take(5)), 0u);
    EXPECT_THROW(read_frame_facts(take(6), camera, 0), Error);
    EXPECT_EQ(read_file(take(7)), read_file(first));
    EXPECT_EQ(read_frame_facts(take(8), camera, 0).exposure_s, 0.5);
    EXPECT_NE(read_file(take(9)), read_file(first));
}

} // namespace
} // namespace tsuya::lab

// A patch that moves in the picture behind a lens that leaves less at its edge, and a monitor of
// the lamp in every picture.

#include <gtest/gtest.h>

#include "lab/small_session.h"
#include "samples/scratch.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

using scene::Scratch, test::VirtualSession, test::small_session, test::worst_of;

constexpr int kWidth = 128, kHeight = 96;
constexpr double kVignetting = 0.3;

/// The camera's axis meets that of the stage in straight views alone: the patch moves to the right.
VirtualSession moving_session() {
    VirtualSession made = small_session();
    made.camera = {.width = kWidth, .height = kHeight, .vignetting = kVignetting};
    made.camera_lines += "[camera.patch_at]\ntheta_deg = [0, 80]\nx = [64, 103]\ny = [48, 40]\n";
    return made;
}

/// What the lens leaves of even light, as a picture.
void write_flat(const std::filesystem::path &file, double level = 10000, int width = kWidth) {
    CameraFrame flat{.image = Image::make(width, kHeight, {"Y"}), .exposure_s = 1};
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = (x + 0.5) / (0.5 * kWidth) - 1, v = (y + 0.5) / (0.5 * kHeight) - 1;
            const double half2 = 0.25 * (kWidth * kWidth + kHeight * kHeight);
            const double r2 = 0.25 * (u * u * kWidth * kWidth + v * v * kHeight * kHeight) / half2;
            flat.image.pixel(x, y)[0] =
                static_cast<float>(std::round(512 + level * (1 - kVignetting * r2)));
        }
    write_frame(file, flat);
}

MeasureSettings settings_of(const VirtualSession &made, const Corrections &corrections = {}) {
    return {.repeat_mm = made.scene.repeat_mm, .corrections = corrections};
}

/// A session in the folder whose rig has a flat field.
Session flat_session(const std::filesystem::path &folder, VirtualSession &made) {
    std::filesystem::create_directories(folder);
    write_flat(folder / "flat.tif");
    made.camera_lines.insert(0, "flat = \"flat.tif\"\n");
    return make_virtual_session(folder, made);
}

TEST(FlatField, TakesTheLensOutOfAPatchThatMoves) {
    const Scratch folder;
    VirtualSession made = moving_session();
    const Session session = flat_session(folder / "s", made);
    const SessionMeasurement measured = measure_session(session, settings_of(made));
    EXPECT_EQ(measured.channels[0].views.size(), 30u);
    EXPECT_LT(worst_of(measured.channels[0], made), 0.01);
    EXPECT_EQ(measured.warnings.size(), 1u) << "that the lamp does not flicker";
    const SessionMeasurement without = measure_session(session, settings_of(made, {.flat = false}));
    EXPECT_GT(worst_of(without.channels[0], made), 0.03) << "the negative control";
}

TEST(FlatField, IsMissedWhereThePatchMoves) {
    const Scratch folder;
    const VirtualSession made = moving_session();
    const SessionMeasurement measured =
        measure_session(make_virtual_session(folder / "s", made), settings_of(made));
    EXPECT_NE(measured.warnings[0].find("without a flat field"), std::string::npos)
        << measured.warnings[0];
}

TEST(FlatField, OfAnotherSizeOrClippedIsRefused) {
    const Scratch folder;
    VirtualSession made = moving_session();
    const Session session = flat_session(folder / "s", made);
    const auto problem = [&] {
        try {
            measure_session(session, settings_of(made));
        } catch (const Error &error) {
            return error.problems()[0].what;
        }
        return std::string("none");
    };
    write_flat(folder / "s/flat.tif", 10000, kWidth + 2);
    EXPECT_EQ(problem(), "the picture has 130 x 96 pixels");
    write_flat(folder / "s/flat.tif", 15000);
    EXPECT_EQ(problem(), "the flat field has a pixel that is clipped");
    write_flat(folder / "s/flat.tif", 0);
    EXPECT_EQ(problem(), "the flat field has a pixel that is dark");
}

/// A lamp that jumps by 10 % between two white frames and flickers; its fibre ends in the corner.
VirtualSession monitored_session(double monitor_dn_per_s) {
    VirtualSession made = small_session();
    made.camera = {.width = 96, .height = 96, .monitor_dn_per_s = monitor_dn_per_s};
    made.camera_lines += "monitor = [2, 3, 20, 16]\n";
    made.scene.flicker = 0.02;
    made.jump_at = 10;
    made.jump = 1.1;
    return made;
}

TEST(LampMonitor, TellsTheLampOfEveryFrame) {
    const Scratch folder;
    const VirtualSession made = monitored_session(1000);
    const Session session = make_virtual_session(folder / "s", made);
    const SessionMeasurement measured = measure_session(session, settings_of(made));
    EXPECT_TRUE(measured.left_out.empty());
    EXPECT_EQ(measured.channels[0].views.size(), 30u);
    EXPECT_LT(worst_of(measured.channels[0], made), 0.01);
    EXPECT_LT(measured.channels[0].flicker, 0.004);
    int within = 0;
    for (const MeasuredView &view : measured.channels[0].views) {
        EXPECT_GT(view.drift, 0);
        within +=
            std::abs(view.brdf_per_sr - made.scene.cloth(view.directions)) < 2 * view.sigma_per_sr()
                ? 1
                : 0;
    }
    EXPECT_GE(within, 26) << "sigma holds the monitor's noise";
    const SessionMeasurement without =
        measure_session(session, settings_of(made, {.monitor = false}));
    EXPECT_FALSE(without.left_out.empty()) << "the negative control: the jump";
    EXPECT_GT(worst_of(without.channels[0], made), 0.02) << "the negative control: flicker";
}

// The longest exposure clips it, and the others stand in.
TEST(LampMonitor, MayBeClippedInSomeExposures) {
    const Scratch folder;
    VirtualSession made = monitored_session(3000);
    made.scene.flicker = 0;
    const SessionMeasurement measured =
        measure_session(make_virtual_session(folder / "s", made), settings_of(made));
    EXPECT_TRUE(measured.left_out.empty());
    EXPECT_LT(worst_of(measured.channels[0], made), 0.01);
}

TEST(LampMonitor, ThatIsDarkLeavesAViewWithoutReference) {
    const Scratch folder;
    VirtualSession made = monitored_session(1000);
    const Session session = make_virtual_session(folder / "s", made);
    const std::size_t dark = test::plan_view(session.plan, 4);
    std::size_t trap = 0;
    for (const CountedFrame &frame : session.frames) {
        if (frame.planned.kind == FrameKind::trap)
            trap = frame.planned.view;
        if (frame.planned.view != dark && (trap == 0 || frame.planned.view != trap))
            continue;
        CameraFrame picture = read_frame(frame.file);
        for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
                picture.image.pixel(x, y)[0] = 512;
        write_frame(frame.file, picture);
    }
    const SessionMeasurement measured = measure_session(session, settings_of(made));
    ASSERT_EQ(measured.left_out.size(), 1u);
    EXPECT_EQ(measured.left_out[0].view, dark);
    EXPECT_EQ(measured.left_out[0].reason, LeftOutReason::no_reference);
    EXPECT_EQ(measured.warnings[0].find("2 views of the white standard or the trap"), 0u)
        << measured.warnings[0];
}

} // namespace
} // namespace tsuya::lab

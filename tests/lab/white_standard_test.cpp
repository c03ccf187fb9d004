// What the white standard is to a measurement.
#include "tsuya/lab/measure_session.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lab/small_session.h"
#include "samples/scratch.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/view_geometry.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

using scene::Scratch, test::VirtualSession, test::small_session, test::worst_of;

TEST(WhiteStandard, TheHeightOfTheStandardIsCorrected) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.scene.stray = 0;
    Session session = make_virtual_session(folder / "s", made);
    const double level = measure_session(session, {.repeat_mm = made.scene.repeat_mm})
                             .channels[0]
                             .views[0]
                             .brdf_per_sr;
    session.rig.white.height_mm = 2;
    session.rig.lamp.spot_mm = 30;
    session.rig.lamp.distance_mm = 600;
    const ChannelMeasurement raised =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm}).channels[0];
    const DirectionPair reference{.theta_r = 45 * kDegree, .phi_r = 90 * kDegree};
    EXPECT_NEAR(raised.views[0].brdf_per_sr / level, raised_irradiance(2, 30, 600, reference),
                1e-6);
    EXPECT_EQ(raised.table.keys.at("white_height_mm").substr(0, 1), "2");
}

TEST(WhiteStandard, TheStandardsOwnTableAndSpectrumAreUsed) {
    const Scratch folder;
    VirtualSession made = small_session();
    const Session session = make_virtual_session(folder / "s", made);
    const double number = measure_session(session, {.repeat_mm = made.scene.repeat_mm})
                              .channels[0]
                              .views[0]
                              .brdf_per_sr;
    Session other = session;
    write_file(folder / "white.csv", "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n"
                                     "0,0,45,90,0.2\n30,11.4591559,45,101.4591559,0.2\n");
    other.rig.white.rho_std = folder / "white.csv";
    const double table = measure_session(other, {.repeat_mm = made.scene.repeat_mm})
                             .channels[0]
                             .views[0]
                             .brdf_per_sr;
    EXPECT_NEAR(table / number, 0.2 * kPi / 0.99, 1e-6);
    write_file(folder / "spectrum.csv", "wavelength_nm,value\n400,0.4\n700,0.6\n");
    other.rig.white.rho_std = folder / "spectrum.csv";
    const double spectrum = measure_session(other, {.repeat_mm = made.scene.repeat_mm})
                                .channels[0]
                                .views[0]
                                .brdf_per_sr;
    EXPECT_NEAR(spectrum / number, 0.5 / 0.99, 1e-6);
    write_file(folder / "white.csv",
               "theta_i_deg,phi_i_deg,theta_r_deg,phi_r_deg,brdf_per_sr\n0,0,50,90,0.2\n");
    other.rig.white.rho_std = folder / "white.csv";
    EXPECT_THROW(measure_session(other, {.repeat_mm = made.scene.repeat_mm}), Error);
}

TEST(WhiteStandard, AStandardTakenForAnIdealDiffuserWidensSigma) {
    const Scratch folder;
    VirtualSession made = small_session();
    Session session = make_virtual_session(folder / "s", made);
    session.rig.white.sigma = 0.03;
    const SessionMeasurement measured =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm});
    for (const MeasuredView &view : measured.channels[0].views)
        EXPECT_NEAR(view.white / view.brdf_per_sr,
                    view.directions.theta_r > 45 * kDegree ? 0.03 : 0, 1e-12);
}

// As where the lamp is looked at while it warms up, in one exposure that turns out too long.
TEST(WhiteStandard, ClippedWhiteFramesAreNoReference) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.scene.flicker = 0.002;
    Session session = make_virtual_session(folder / "s", made);
    CountedFrame beside;
    for (const CountedFrame &frame : session.frames)
        if (frame.planned.kind == FrameKind::white && frame.planned.exposure_s == 10)
            beside = frame;
    const std::size_t white_view = beside.planned.view;
    CameraFrame clipped = read_frame(beside.file);
    std::fill(clipped.image.data.begin(), clipped.image.data.end(), 15800.0f);
    beside.number.reset();
    beside.file = folder / "clipped.tif";
    beside.time_s = session.frames.front().time_s - 60;
    write_frame(beside.file, clipped);
    const MeasureSettings settings{.repeat_mm = made.scene.repeat_mm};
    const SessionMeasurement before = measure_session(session, settings);
    session.warm_up.push_back(beside);
    const SessionMeasurement after = measure_session(session, settings);
    EXPECT_EQ(after.channels[0].flicker, before.channels[0].flicker);
    EXPECT_EQ(after.channels[0].views[0].brdf_per_sr, before.channels[0].views[0].brdf_per_sr);
    EXPECT_EQ(after.warnings, before.warnings);
    for (const CountedFrame &frame : session.frames) // the last of the plan
        if (frame.planned.view == white_view) {
            clipped.exposure_s = frame.planned.exposure_s;
            write_frame(frame.file, clipped);
        }
    const SessionMeasurement planned = measure_session(session, settings);
    ASSERT_EQ(planned.warnings.size(), before.warnings.size() + 1);
    EXPECT_NE(planned.warnings[0].find("1 view of the white standard"), std::string::npos);
}

} // namespace
} // namespace tsuya::lab

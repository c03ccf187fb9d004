#include "tsuya/lab/measure_session.h"

#include <cmath>
#include <numeric>

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

TEST(MeasureSession, FindsTheReflectanceOfEveryView) {
    const Scratch folder;
    const VirtualSession made = small_session();
    const Session session = make_virtual_session(folder / "s", made);
    const SessionMeasurement measured =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm});
    ASSERT_EQ(measured.channels.size(), 1u);
    const ChannelMeasurement &channel = measured.channels[0];
    EXPECT_EQ(channel.name, "Y");
    ASSERT_EQ(channel.views.size(), 30u);
    EXPECT_TRUE(measured.left_out.empty());
    EXPECT_LT(worst_of(channel, made), 0.01);
    ASSERT_EQ(measured.warnings.size(), 1u) << "the lamp of this session does not flicker";
    EXPECT_NE(measured.warnings[0].find("flicker"), std::string::npos);
    EXPECT_EQ(channel.table.rows.size(), 30u);
    EXPECT_EQ(channel.table.symmetry, Symmetry::half_turn);
    EXPECT_EQ(channel.lamp.size(), 2u);
    for (const char *key : {"instrument", "camera", "lamp", "white_standard", "provenance"})
        EXPECT_TRUE(channel.table.keys.contains(key)) << key;
    EXPECT_NE(channel.table.keys.at("provenance").find(session.journal_hash), std::string::npos);
    EXPECT_NE(channel.table.keys.at("lamp").find("MH-1"), std::string::npos);
    for (const MeasuredView &view : channel.views) {
        EXPECT_GT(view.noise, 0);
        EXPECT_GT(view.drift, 0);
        EXPECT_DOUBLE_EQ(view.sigma_per_sr(), std::hypot(view.noise, view.drift, view.texture));
    }
}

TEST(MeasureSession, EachViewsOwnWhiteCancelsWhatTheStandardDoes) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.white = WhiteUse::each_view;
    const SessionMeasurement measured = measure_session(make_virtual_session(folder / "s", made),
                                                        {.repeat_mm = made.scene.repeat_mm});
    EXPECT_EQ(measured.channels[0].views.size(), 30u);
    EXPECT_LT(worst_of(measured.channels[0], made), 0.01);
}

/// The reasons, in the order of the views of the cloth that were meddled with.
std::vector<LeftOutReason> reasons(const SessionMeasurement &measured) {
    std::vector<LeftOutReason> list;
    for (const LeftOutView &view : measured.left_out)
        list.push_back(view.reason);
    return list;
}

TEST(MeasureSession, NamesWhatItLeavesOut) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.glint_view = 1;
    made.missing_views = {3};
    const DirectionPair black = made.directions.pairs[5];
    const auto cloth = made.scene.cloth;
    made.scene.cloth = [=](const DirectionPair &d) { return d == black ? 0.0 : cloth(d); };
    made.scene.stray = 0;
    const Session session = make_virtual_session(folder / "s", made);
    const auto file_of = [&](std::size_t n) {
        for (const CountedFrame &frame : session.frames)
            if (frame.planned.view == test::plan_view(session.plan, n) &&
                frame.planned.exposure_s == 10)
                return frame.file;
        throw std::invalid_argument("no such view");
    };
    for (const CountedFrame &frame : session.frames)
        if (frame.planned.view == test::plan_view(session.plan, 7)) {
            CameraFrame blurred = // out of focus
                read_frame(frame.file);
            const float level =
                std::accumulate(blurred.image.data.begin(), blurred.image.data.end(), 0.0f) /
                static_cast<float>(blurred.image.data.size());
            std::fill(blurred.image.data.begin(), blurred.image.data.end(), std::round(level));
            write_frame(frame.file, blurred);
        }
    for (const CountedFrame &frame : session.frames)
        if (frame.planned.view == test::plan_view(session.plan, 9)) {
            CameraFrame edge = read_frame(frame.file); // half of the patch is no cloth
            for (int y = 0; y < edge.image.height; ++y)
                for (int x = 30; x < edge.image.width; ++x)
                    edge.image.pixel(x, y)[0] = 512;
            write_frame(frame.file, edge);
        }
    CameraFrame shorter = read_frame(file_of(11));
    shorter.exposure_s = 5;
    write_frame(file_of(11), shorter);
    write_file(file_of(13), "no picture");

    const SessionMeasurement measured =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm});
    EXPECT_EQ(
        reasons(measured),
        (std::vector{LeftOutReason::saturated, LeftOutReason::missing, LeftOutReason::underexposed,
                     LeftOutReason::unsharp, LeftOutReason::misplaced,
                     LeftOutReason::wrong_exposure, LeftOutReason::missing}));
    const std::size_t views[] = {1, 3, 5, 7, 9, 11, 13};
    for (std::size_t i = 0; i < measured.left_out.size() && i < 7; ++i) {
        EXPECT_EQ(measured.left_out[i].view, test::plan_view(session.plan, views[i]));
        EXPECT_FALSE(measured.left_out[i].detail.empty());
    }
    EXPECT_EQ(measured.channels[0].views.size(), 23u);
    EXPECT_STREQ(name_of(LeftOutReason::wrong_exposure), "wrong-exposure");
}

/// Overwrites the frames of one direction of light, as under a lamp that has gone out.
void darken(const Session &session, double theta_i) {
    for (const CountedFrame &frame : session.frames)
        if (frame.planned.kind != FrameKind::dark &&
            std::abs(frame.planned.directions.theta_i - theta_i) < 1e-6) {
            CameraFrame picture = read_frame(frame.file);
            std::fill(picture.image.data.begin(), picture.image.data.end(), 513.0f);
            write_frame(frame.file, picture);
        }
}

// A row of 0 would say that the cloth is black there.
TEST(MeasureSession, LightsThatNoFrameMeasuredHaveNoRows) {
    const Scratch folder;
    const VirtualSession made = small_session();
    const Session session = make_virtual_session(folder / "s", made);
    const auto expect_one_light = [](const SessionMeasurement &measured, LeftOutReason reason) {
        EXPECT_EQ(measured.channels[0].table.rows.size(), 15u);
        for (const ReflectanceRow &row : measured.channels[0].table.rows) {
            EXPECT_LT(row.theta_i, 1e-6);
            EXPECT_GT(row.brdf_per_sr, 0.01);
        }
        EXPECT_EQ(reasons(measured), std::vector<LeftOutReason>(15, reason));
    };
    Session half = session; // as where the session was ended early
    std::erase_if(half.frames, [&](const CountedFrame &frame) {
        const bool second = frame.planned.directions.theta_i > 0.1;
        if (second)
            half.missing.push_back(*frame.number);
        return second;
    });
    expect_one_light(measure_session(half), LeftOutReason::missing);
    darken(session, 30 * kDegree);
    const SessionMeasurement dark = measure_session(session);
    expect_one_light(dark, LeftOutReason::no_reference);
    EXPECT_NE(dark.warnings[0].find("4 views of the white standard are dark"), std::string::npos)
        << dark.warnings[0];
}

// The trap says what is stray light: what is left of a black view is noise about 0.
TEST(MeasureSession, ABlackViewBehindStrayLightIsUnderexposed) {
    const Scratch folder;
    VirtualSession made = small_session();
    const DirectionPair black = made.directions.pairs[5];
    const auto cloth = made.scene.cloth;
    made.scene.cloth = [=](const DirectionPair &d) { return d == black ? 0.0 : cloth(d); };
    made.scene.stray = 0.01;
    const SessionMeasurement measured = measure_session(make_virtual_session(folder / "s", made),
                                                        {.repeat_mm = made.scene.repeat_mm});
    EXPECT_EQ(reasons(measured), std::vector{LeftOutReason::underexposed});
    EXPECT_EQ(measured.channels[0].views.size(), 29u);
}

// As where the lamp is looked at while it warms up, in one exposure that turns out too long.
TEST(MeasureSession, ClippedWhiteFramesAreNoReference) {
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
    EXPECT_NE(planned.warnings[0].find("1 views of the white standard"), std::string::npos);
}

TEST(MeasureSession, NobodyTakesADryRunForAMeasurement) {
    const Scratch folder;
    Session session = make_virtual_session(folder / "s", small_session());
    session.dry_run = true;
    const auto keys = measure_session(session).channels[0].table.keys;
    EXPECT_EQ(keys.at("instrument"), "dry run of a camera goniometer");
    EXPECT_EQ(keys.at("camera"), "virtual camera");
    EXPECT_EQ(keys.at("lamp"), "none");
}

TEST(MeasureSession, AJumpOfTheLampCostsTheViewsAboutIt) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.jump_at = 10;
    made.jump = 1.1;
    const Session session = make_virtual_session(folder / "s", made);
    const SessionMeasurement measured =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm});
    ASSERT_EQ(measured.left_out.size(), 7u) << "from white frame to white frame";
    for (const LeftOutView &view : measured.left_out)
        EXPECT_EQ(view.reason, LeftOutReason::lamp_jump);
    EXPECT_LT(worst_of(measured.channels[0], made), 0.01);
    // With a limit that takes it for drift the views are wrong.
    const SessionMeasurement all =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm, .jump_limit = 0.5});
    EXPECT_GT(worst_of(all.channels[0], made), 0.02);
}

TEST(MeasureSession, ThePatchMustBeLitAllOver) {
    const Scratch folder;
    VirtualSession made = small_session();
    Session session = make_virtual_session(folder / "s", made);
    session.rig.lamp.spot_mm = 1.8; // the patch is 0.8 mm: 2.3 mm long at 70 degrees
    const SessionMeasurement measured = measure_session(session);
    ASSERT_EQ(measured.left_out.size(), 6u);
    for (const LeftOutView &view : measured.left_out)
        EXPECT_EQ(view.reason, LeftOutReason::misplaced) << view.detail;
}

TEST(MeasureSession, TheHeightOfTheStandardIsCorrected) {
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

TEST(MeasureSession, TheStandardsOwnTableAndSpectrumAreUsed) {
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

TEST(MeasureSession, AStandardTakenForAnIdealDiffuserWidensSigma) {
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

TEST(MeasureSession, WideLampsAreTold) {
    const Scratch folder;
    VirtualSession made = small_session();
    made.scene.flicker = 0.002;
    Session session = make_virtual_session(folder / "s", made);
    session.rig.lamp.diameter_mm = 320;
    session.rig.lamp.distance_mm = 500;
    const SessionMeasurement measured = measure_session(session);
    EXPECT_NEAR(measured.lamp_angle / kDegree, 35.5, 0.1);
    EXPECT_EQ(measured.aperture_angle, 0);
    ASSERT_EQ(measured.warnings.size(), 1u);
    EXPECT_NE(measured.warnings[0].find("35.49 degrees"), std::string::npos)
        << measured.warnings[0];
    EXPECT_EQ(measured.channels[0].table.keys.at("warning"), measured.warnings[0]);
    const auto warned = [&](double lamp_mm, double lens_mm) {
        session.rig.lamp.diameter_mm = lamp_mm;
        session.rig.camera.aperture_mm = lens_mm;
        session.rig.camera.distance_mm = 500;
        const auto warnings = measure_session(session).warnings;
        return warnings.empty() ? std::string() : warnings[0];
    };
    const double third_mm = 1000 * std::tan(measured.narrowest_lobe / 6);
    EXPECT_EQ(warned(0, 1.1 * third_mm).find("the camera's lens fills "), 0u);
    EXPECT_EQ(warned(0.8 * third_mm, 0.8 * third_mm).find("lamp and lens together blur over "), 0u);
    EXPECT_EQ(warned(0.6 * third_mm, 0.6 * third_mm), "");
}

TEST(MeasureSession, ColoursHaveTablesOfTheirOwn) {
    const Scratch folder;
    VirtualSession made = small_session();
    const Session session = make_virtual_session(folder / "s", made);
    for (const CountedFrame &frame : session.frames) { // red sees 20 % more of the cloth
        const CameraFrame grey = read_frame(frame.file);
        CameraFrame colour = grey;
        colour.image = Image::make(grey.image.width, grey.image.height, {"R", "G", "B"});
        for (std::size_t i = 0; i < grey.image.data.size(); ++i)
            for (std::size_t c = 0; c < 3; ++c)
                colour.image.data[3 * i + c] =
                    c == 0 && frame.planned.kind == FrameKind::cloth
                        ? std::min(std::round(512 + 1.2f * (grey.image.data[i] - 512)), 15800.0f)
                        : grey.image.data[i];
        write_frame(frame.file, colour);
    }
    const SessionMeasurement measured =
        measure_session(session, {.repeat_mm = made.scene.repeat_mm});
    ASSERT_EQ(measured.channels.size(), 3u);
    EXPECT_EQ(measured.channels[0].name, "R");
    EXPECT_NEAR(measured.channels[0].views[0].brdf_per_sr /
                    measured.channels[2].views[0].brdf_per_sr,
                1.2, 0.01);
    EXPECT_NEAR(measured.channel_difference, 0.4 / 3 / (3.2 / 3), 0.01);
}

TEST(MeasureSession, RefusesWhatCannotBeMeasured) {
    const Scratch folder;
    VirtualSession made = small_session();
    const Session session = make_virtual_session(folder / "s", made);
    Session other = session;
    other.rig.camera.pixel_mm = 0;
    EXPECT_THROW(measure_session(other, {.repeat_mm = {{0.4, 0.4}}}), Error);
    EXPECT_THROW(measure_session(session, {.repeat_mm = {{0.4, 0}}}), Error);
    EXPECT_THROW(measure_session(session, {.jump_limit = 0}), Error);
    other = session;
    std::erase_if(other.frames,
                  [](const CountedFrame &f) { return f.planned.kind == FrameKind::white; });
    EXPECT_THROW(measure_session(other), Error);
    other.frames.clear();
    EXPECT_THROW(measure_session(other), Error);
    std::atomic<bool> stop{true};
    EXPECT_THROW(measure_session(session, {}, {.report = {}, .stop = &stop}), Interrupted);
    other = session;
    other.rig.camera.patch = 50;
    EXPECT_THROW(measure_session(other), Error);
}

} // namespace
} // namespace tsuya::lab

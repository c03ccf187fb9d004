#include "tsuya/lab/measure_session.h"

#include <cmath>

#include <gtest/gtest.h>

#include "lab/small_session.h"
#include "samples/scratch.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/view_geometry.h"
#include "tsuya/sdk/error.h"

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

TEST(MeasureSession, NobodyTakesADryRunForAMeasurement) {
    const Scratch folder;
    Session session = make_virtual_session(folder / "s", small_session());
    session.dry_run = true;
    const auto keys = measure_session(session).channels[0].table.keys;
    EXPECT_EQ(keys.at("instrument"), "dry run of a camera goniometer");
    EXPECT_EQ(keys.at("camera"), "virtual camera");
    EXPECT_EQ(keys.at("lamp"), "none");
}

TEST(MeasureSession, WideLampsAreReported) {
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

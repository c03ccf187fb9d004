// Which views a measurement leaves out, and why.
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

/// The reasons, in the order of the views of the cloth that were meddled with.
std::vector<LeftOutReason> reasons(const SessionMeasurement &measured) {
    std::vector<LeftOutReason> list;
    for (const LeftOutView &view : measured.left_out)
        list.push_back(view.reason);
    return list;
}

TEST(LeftOutViews, NamesWhatItLeavesOut) {
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
TEST(LeftOutViews, LightsThatNoFrameMeasuredHaveNoRows) {
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
    EXPECT_NE(dark.warnings[0].find("4 views of the white standard left out: dark"),
              std::string::npos)
        << dark.warnings[0];
}

// The trap says what is stray light: what is left of a black view is noise about 0.
TEST(LeftOutViews, ABlackViewBehindStrayLightIsUnderexposed) {
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

TEST(LeftOutViews, AJumpOfTheLampCostsTheViewsAboutIt) {
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

TEST(LeftOutViews, ThePatchMustBeLitAllOver) {
    const Scratch folder;
    VirtualSession made = small_session();
    Session session = make_virtual_session(folder / "s", made);
    session.rig.lamp.spot_mm = 1.8; // the patch is 0.8 mm: 2.3 mm long at 70 degrees
    const SessionMeasurement measured = measure_session(session);
    ASSERT_EQ(measured.left_out.size(), 6u);
    for (const LeftOutView &view : measured.left_out)
        EXPECT_EQ(view.reason, LeftOutReason::misplaced) << view.detail;
}

} // namespace
} // namespace tsuya::lab

#include "tsuya/lab/planning.h"

#include "samples/scratch.h"
#include "tsuya/lab/rig_motion.h"
#include "tsuya/lab/session.h"
#include "tsuya/sdk/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace tsuya::lab {
namespace {

RigFile sample_rig() { return read_rig_file(TSUYA_RIG_SAMPLE); }

Plan plan_of(const RigFile &rig, const std::string &views,
             std::optional<Symmetry> symmetry = std::nullopt,
             WhiteUse white = WhiteUse::each_light) {
    return make_plan(rig, {.directions = views_named(views, symmetry),
                           .views = views,
                           .rig = TSUYA_RIG_SAMPLE,
                           .white = white});
}

/// Views of a kind, without their repetition by exposures.
std::vector<PlannedFrame> views_of(const Plan &plan, FrameKind kind) {
    std::vector<PlannedFrame> views;
    for (const PlannedFrame &frame : plan.frames)
        if (frame.kind == kind && (views.empty() || views.back().view != frame.view))
            views.push_back(frame);
    return views;
}

TEST(ViewsNamed, AreThoseOfThePaperAndFew) {
    EXPECT_EQ(views_named("few:5", Symmetry::orthotropic).pairs.size(), 324u);
    EXPECT_EQ(views_named("few:5", {}).pairs.size(), 613u);
    const Directions paper = views_named("paper", {});
    EXPECT_EQ(paper.pairs.size(), 33424u);
    EXPECT_EQ(paper.pairs.size() + paper.repeated, 38880u);
    EXPECT_EQ(views_named("few:5", {}).repeated, 0u);
    EXPECT_EQ(views_named("few:90", {}).pairs.size(), 1u);
    EXPECT_EQ(views_named("few:0.5", Symmetry::orthotropic).pairs.size(), 1u + 179u * 181u);
    for (const char *wrong : {"few:", "few:0", "few:0.49", "few:-5", "few:1e-300", "few:91",
                              "few:90.1", "few:5x", "few:nan", "few:inf", "absent.csv"})
        EXPECT_THROW(views_named(wrong, {}), Error) << wrong;
    try {
        views_named("fwe:5", {});
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_TRUE(error.problems()[0].accepted.starts_with("expected few:STEP"));
    }
    try {
        views_named("few:0.1", {});
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].accepted,
                  "expected few: and a step of 0.5 to 90 degrees, such as few:5");
    }
    const scene::Scratch folder;
    write_reflectance_table({.symmetry = Symmetry::none, .rows = {{.theta_r = 0.5}}},
                            folder / "t.csv");
    const Directions of_table = views_named((folder / "t.csv").string(), {});
    EXPECT_EQ(of_table.symmetry, Symmetry::none);
    EXPECT_EQ(of_table.pairs.size(), 1u);
    EXPECT_EQ(views_named((folder / "t.csv").string(), Symmetry::half_turn).symmetry,
              Symmetry::half_turn);
}

// Within 6 degrees of the lamp lie the view from straight above and 19 views at 5 degrees. The
// camera of the sample stops at 80 degrees, which leaves out 19 at 85.
TEST(Planning, LeavesOutByNameWhatTheRigCannotDo) {
    const Plan plan = plan_of(sample_rig(), "few:5", Symmetry::orthotropic);
    ASSERT_EQ(plan.left_out.size(), 20u + 19u);
    EXPECT_EQ(views_of(plan, FrameKind::cloth).size(), 324u - 39u);
    EXPECT_EQ(plan.left_out[0].directions, DirectionPair{});
    EXPECT_EQ(plan.left_out[0].why,
              "geometry.dead_cone_deg: lamp and camera would be 0 degrees apart");
    EXPECT_EQ(plan.left_out.back().why, "axes.camera: the drive does not reach 85 degrees");
    EXPECT_EQ(plan.rig_hash, file_hash(TSUYA_RIG_SAMPLE));
}

TEST(Planning, TakesEachViewOnceInEachExposure) {
    const RigFile rig = sample_rig();
    const Plan plan = plan_of(rig, "few:5");
    std::set<std::pair<long, long>> seen;
    for (const PlannedFrame &view : views_of(plan, FrameKind::cloth))
        EXPECT_TRUE(seen.emplace(std::lround(view.directions.theta_r / kDegree),
                                 std::lround(view.directions.phi_r / kDegree))
                        .second);
    EXPECT_EQ(seen.size() + plan.left_out.size(), 613u);
    const std::size_t exposures = rig.camera.exposures_s.size();
    ASSERT_EQ(plan.frames.size() % exposures, 0u);
    for (std::size_t i = 0; i < plan.frames.size(); ++i) {
        EXPECT_EQ(plan.frames[i].view, i / exposures);
        EXPECT_EQ(plan.frames[i].exposure_s, rig.camera.exposures_s[i % exposures]);
    }
}

// White at the beginning, after each 50 views, at the end; dark at both ends; one trap.
TEST(Planning, SurroundsTheViewsWithWhiteAndDark) {
    const Plan plan = plan_of(sample_rig(), "few:5", Symmetry::orthotropic);
    std::string kinds;
    for (std::size_t i = 0; i < plan.frames.size(); i += 4)
        kinds += name_of(plan.frames[i].kind)[0];
    std::string expected = "dwt";
    for (int left = 285; left > 0; left -= 50)
        expected += std::string(static_cast<std::size_t>(std::min(left, 50)), 'c') + "w";
    EXPECT_EQ(kinds, expected + "d");
    for (const PlannedFrame &white : views_of(plan, FrameKind::white)) {
        EXPECT_NEAR(white.directions.theta_r, 45 * kDegree, 1e-12);
        EXPECT_NEAR(white.directions.phi_r, 90 * kDegree, 1e-12);
    }
}

// Each direction of light has its own whites about its views, and its trap.
TEST(Planning, GroupsByTheDirectionOfLight) {
    const Plan plan = plan_of(sample_rig(), "paper");
    EXPECT_EQ(views_of(plan, FrameKind::trap).size(), 16u);
    const PlannedFrame *white = nullptr;
    std::size_t since = 0, left_out = plan.left_out.size(), cloth = 0;
    for (std::size_t i = 0; i < plan.frames.size(); i += 4) {
        const PlannedFrame &frame = plan.frames[i];
        since = frame.kind == FrameKind::white ? 0 : since + 1;
        if (frame.kind == FrameKind::white)
            white = &frame;
        if (frame.kind != FrameKind::cloth)
            continue;
        ++cloth;
        ASSERT_EQ(frame.directions.theta_i, white->directions.theta_i);
        ASSERT_EQ(frame.directions.phi_i, white->directions.phi_i);
        ASSERT_LE(since, 51u); // the trap may stand between
    }
    EXPECT_EQ(cloth + left_out, 33424u);
    EXPECT_EQ(plan.frames.back().kind, FrameKind::dark);
}

TEST(Planning, WhiteOfEachViewComesBeforeItsBlock) {
    const Plan plan = plan_of(sample_rig(), "few:15", Symmetry::orthotropic, WhiteUse::each_view);
    const auto cloth = views_of(plan, FrameKind::cloth), white = views_of(plan, FrameKind::white);
    ASSERT_EQ(white.size(), cloth.size() + 2);
    for (std::size_t i = 0; i < cloth.size(); ++i)
        EXPECT_EQ(white[i + 1].directions, cloth[i].directions);
}

std::size_t moves_of(const Plan &plan, const RigFile &rig, AxisName axis) {
    return estimate(plan, rig).moves[static_cast<std::size_t>(axis)];
}

// Views from 10 to 80 degrees: 15 angles of the camera. Each visit of the reference costs it at
// most two more. Where the stage is the slower one, it has 37 angles and the camera moves often.
TEST(Planning, MovesTheSlowestAxisLeast) {
    RigFile rig = sample_rig();
    Plan plan = plan_of(rig, "few:5");
    const std::size_t visits = views_of(plan, FrameKind::white).size();
    EXPECT_LE(moves_of(plan, rig, AxisName::camera), 15 + 2 * visits);
    EXPECT_GT(moves_of(plan, rig, AxisName::stage), 500u);
    rig.axes[static_cast<std::size_t>(AxisName::stage)].move = Seconds(100);
    plan = plan_of(rig, "few:5");
    EXPECT_LE(moves_of(plan, rig, AxisName::stage), 37 + 2 * visits);
    EXPECT_GT(moves_of(plan, rig, AxisName::camera), 500u);
    EXPECT_EQ(moves_of(plan, rig, AxisName::lamp_theta), 0u);
}

// The stage does not run back to its beginning whenever the camera has moved.
TEST(Planning, PassesFastAxesForthAndBack) {
    const auto cloth = views_of(plan_of(sample_rig(), "few:5"), FrameKind::cloth);
    ASSERT_GT(cloth.size(), 500u);
    for (std::size_t i = 1; i < cloth.size(); ++i)
        EXPECT_LT(std::abs(cloth[i].directions.phi_r - cloth[i - 1].directions.phi_r),
                  5.1 * kDegree)
            << "view " << cloth[i].view;
}

// One view: dark, white, trap, cloth, white, dark, in one exposure of 1 s.
TEST(Planning, EstimatesWhatASessionTakes) {
    RigFile rig;
    rig.camera.exposures_s = {1};
    rig.camera.frame_mb = 3;
    rig.camera.transfer = Seconds(1.5);
    rig.shutter.max_duty = 1;
    rig.lamp.warm_up = Seconds(100);
    rig.sample.change = Seconds(30);
    for (RigAxis &axis : rig.axes)
        axis.move = Seconds(2);
    const Plan plan = make_plan(
        rig, {.directions = {.pairs = {{.theta_r = 45 * kDegree, .phi_r = 90 * kDegree}}}});
    const PlanEstimate sum = estimate(plan, rig);
    EXPECT_EQ(sum.frames, 6u);
    EXPECT_EQ(sum.views, 6u);
    EXPECT_EQ(sum.strikes, 1);
    EXPECT_EQ(sum.disk_mb, 18);
    EXPECT_EQ(sum.sample_changes, 4u);
    EXPECT_EQ(sum.moves, (std::array<std::size_t, kAxes>{0, 1, 1, 1}));
    EXPECT_NEAR(sum.time.count(), 100 + 6 * 2.5 + 3 * 2 + 4 * 30, 1e-9);
    rig.shutter.max_duty = 0.25;
    EXPECT_NEAR(estimate(plan, rig).time.count(), 100 + 6 * 4 + 3 * 2 + 4 * 30, 1e-9);
}

TEST(Planning, IsRefusedWhereNothingCanBeTaken) {
    RigFile rig = sample_rig();
    const auto error_of = [&](const PlanRequest &request) {
        try {
            make_plan(rig, request);
        } catch (const Error &error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    PlanRequest request{.directions = views_named("few:45", Symmetry::orthotropic)};
    EXPECT_EQ(error_of({}), "no view is left to be planned; expected at least one view");
    request.white_every = 0;
    EXPECT_EQ(error_of(request), "white_every: is 0; expected at least 1 view");
    request.white_every = 1;
    rig.axes[static_cast<std::size_t>(AxisName::stage)].limits_deg = {-10, 10};
    EXPECT_TRUE(error_of(request).starts_with(
        "light from theta 0, phi 0 degrees: the reference view of the white standard"))
        << error_of(request);
}

} // namespace
} // namespace tsuya::lab

#include "tsuya/lab/session_pictures.h"

#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "crowded_places.h"
#include "drawing.h"
#include "lab/virtual_session.h"
#include "samples/scratch.h"
#include "tsuya/lab/planning.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

using scene::Scratch, test::VirtualSession;

std::size_t count(const std::string &text, const std::string &part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size())
        ++found;
    return found;
}

Plan sample_plan() {
    return make_plan(
        read_rig_file(TSUYA_RIG_SAMPLE),
        {.directions = views_named("few:15", Symmetry::orthotropic), .views = "few:15 <&>"});
}

TEST(SessionPictures, APlansViewsStandWhereTheyAreSeen) {
    const Plan plan = sample_plan();
    const std::string svg = plan_picture(plan);
    std::size_t cloth = 0;
    for (const PlannedFrame &frame : plan.frames)
        cloth += frame.kind == FrameKind::cloth && frame.exposure_s == 1 ? 1 : 0;
    EXPECT_EQ(count(svg, ", cloth: theta_r"), cloth);
    EXPECT_EQ(count(svg, ", white: theta_r"), 2u);
    EXPECT_EQ(plan.left_out.size(), 1u) << "straight above, where the lamp is";
    EXPECT_EQ(count(svg, "<title>geometry.dead_cone_deg"), plan.left_out.size());
    EXPECT_NE(svg.find("left out, geometry.dead_cone_deg: 1<"), std::string::npos);
    EXPECT_NE(svg.find("few:15 &lt;&amp;&gt;: "), std::string::npos) << "a name is no markup";
    // A disk of radius 250 in the middle of (266, 326): 60 degrees along the warp is above it.
    const std::regex seen("cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"[^>]*><title>view [0-9]+, cloth: "
                          "theta_r 60°, phi_r 90°");
    std::smatch place;
    ASSERT_TRUE(std::regex_search(svg, place, seen));
    EXPECT_NEAR(std::stod(place[1]), 266, 0.01);
    EXPECT_NEAR(std::stod(place[2]), 326 - 250 * 60 / 90.0, 0.01);
}

TEST(SessionPictures, CrossesThatWouldOverlapAreOnePatchWithTheirNumber) {
    const Plan plan =
        make_plan(read_rig_file(TSUYA_RIG_SAMPLE),
                  {.directions = views_named("few:5", Symmetry::half_turn), .views = "few:5"});
    const std::string svg = plan_picture(plan);
    // About the lamp, 36 views of one circle with a radius of 5 degrees, and its middle
    EXPECT_EQ(count(svg, "<title>geometry.dead_cone_deg"), 1u);
    EXPECT_NE(svg.find("; 37 views here</title>"), std::string::npos);
    EXPECT_EQ(count(svg, ">37 left out</text>"), 1u);
    EXPECT_NE(svg.find("shaded: crosses that would overlap"), std::string::npos);
    // At 85 degrees they are apart.
    EXPECT_EQ(count(svg, "<title>axes.camera"), 36u);
    EXPECT_EQ(count(svg, "36 left out"), 0u);
    EXPECT_EQ(plan_picture(sample_plan()).find("shaded"), std::string::npos);
}

TEST(SessionPictures, PlacesAreCrowdedWhereTwoOverlap) {
    const std::vector<glm::dvec2> places{{0, 0}, {10, 0}, {1.5, 0}, {20, 0}, {22.5, 0}, {4, 0}};
    const Crowds sorted = sort_out_crowds(places, 2, 3);
    ASSERT_EQ(sorted.crowds.size(), 1u) << "20 and 22.5 are neighbours that do not overlap";
    EXPECT_EQ(std::set(sorted.crowds[0].begin(), sorted.crowds[0].end()),
              (std::set<std::size_t>{0, 2, 5}));
    EXPECT_EQ(std::set(sorted.alone.begin(), sorted.alone.end()), (std::set<std::size_t>{1, 3, 4}));
    EXPECT_TRUE(sort_out_crowds({}, 2, 3).crowds.empty());
}

TEST(SessionPictures, ManyLightsHaveDisksOfTheirOwn) {
    Plan plan = sample_plan();
    for (int light = 1; light < 30; ++light)
        plan.frames.push_back({.view = plan.frames.back().view + 1,
                               .directions = {.theta_i = light * kDegree, .theta_r = 0.5},
                               .exposure_s = 1});
    const std::string svg = plan_picture(plan);
    EXPECT_EQ(count(svg, ">light from theta"), 24u);
    EXPECT_NE(svg.find("6 more directions of light are not drawn"), std::string::npos);
}

VirtualSession three_views() {
    VirtualSession made;
    for (const double theta_deg : {20.0, 40.0, 60.0})
        made.directions.pairs.push_back({0, 0, theta_deg * kDegree, 0});
    made.scene.cloth = [](const DirectionPair &d) { return d.theta_r < 0.5 ? 0.05 : 0.005; };
    made.glint_view = 2;
    return made;
}

TEST(SessionPictures, AMapTellsValuesByColourAndWhatIsLeftOut) {
    const Scratch folder;
    Session session = make_virtual_session(folder / "s", three_views());
    session.plan.left_out = {{.directions = {.theta_r = 1.5}, .why = "axes.camera: too far"}};
    const SessionMeasurement measured = measure_session(session);
    const std::string svg = table_picture(session, measured);
    EXPECT_EQ(count(svg, " 1/sr</title>"), 2u);
    EXPECT_EQ(count(svg, scale_colour(1) + "\"><title>"), 1u) << "the larger";
    EXPECT_EQ(count(svg, scale_colour(0) + "\"><title>"), 1u) << "the smaller";
    EXPECT_NE(svg.find("left out, saturated: 1<"), std::string::npos);
    EXPECT_NE(svg.find("left out, axes.camera: 1<"), std::string::npos);
    EXPECT_NE(svg.find("<title>view " + std::to_string(test::plan_view(session.plan, 2)) +
                       ", saturated: "),
              std::string::npos);
    SessionMeasurement black = measured;
    for (MeasuredView &view : black.channels[0].views)
        view.brdf_per_sr = 0;
    EXPECT_EQ(count(table_picture(session, black), "nan"), 0u);
}

/// How many pixels have the colour.
int pixels(const Image &image, const std::array<float, 3> &colour) {
    int found = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            found += std::equal(colour.begin(), colour.end(), image.pixel(x, y)) ? 1 : 0;
    return found;
}

TEST(SessionPictures, TheSheetMarksThePatchAndClippedPixels) {
    const Scratch folder;
    const Session session = make_virtual_session(folder / "s", three_views());
    const SessionMeasurement measured = measure_session(session);
    ASSERT_EQ(measured.left_out.size(), 1u);
    const Image sheet = contact_sheet(session, measured);
    // Three views of the cloth, dark, white and trap; 48 pixels enlarged four times, of a patch of
    // 64 whose outline is two pixels wide.
    EXPECT_EQ(pixels(sheet, {1.0f, 0.85f, 0.1f}), 6 * (68 * 68 - 64 * 64));
    EXPECT_GT(pixels(sheet, {1.0f, 0.1f, 0.1f}), 64 * 64) << "the patch of the clipped view";
    EXPECT_GE(sheet.width, 6 * 192);
}

TEST(SessionPictures, TheSheetLeavesOutFramesThatCannotBeRead) {
    const Scratch folder;
    const Session session = make_virtual_session(folder / "s", three_views());
    const SessionMeasurement measured = measure_session(session);
    for (const CountedFrame &frame : session.frames)
        if (frame.planned.kind == FrameKind::cloth)
            write_file(frame.file, "no picture");
    EXPECT_EQ(pixels(contact_sheet(session, measured), {1.0f, 0.85f, 0.1f}),
              3 * (68 * 68 - 64 * 64));
    for (const CountedFrame &frame : session.frames)
        write_file(frame.file, "no picture");
    EXPECT_THROW(contact_sheet(session, measured), Error);
}

} // namespace
} // namespace tsuya::lab

#include "tsuya/lab/session_pictures.h"

#include <map>

#include "hemisphere_picture.h"
#include "left_out_marks.h"
#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::lab {
namespace {

constexpr const char *kWhite = "#d02090";

std::string told(const PlannedFrame &frame) {
    return "view " + std::to_string(frame.view) + ", " + name_of(frame.kind) + ": theta_r " +
           number_text(frame.directions.theta_r / kDegree, 4) + "°, phi_r " +
           number_text(frame.directions.phi_r / kDegree, 4) + "°";
}

/// The first frame of each view of cloth and of the standard.
std::vector<PlannedFrame> views_of(const Plan &plan) {
    std::vector<PlannedFrame> views;
    for (std::size_t i = 0; i < plan.frames.size(); ++i)
        if (i == 0 || plan.frames[i].view != plan.frames[i - 1].view)
            views.push_back(plan.frames[i]);
    return views;
}

} // namespace

std::string plan_picture(const Plan &plan) {
    const std::vector<PlannedFrame> views = views_of(plan);
    std::map<FrameKind, std::size_t> counts;
    for (const PlannedFrame &view : views)
        ++counts[view.kind];
    HemispherePicture picture{
        .title = plan.views + ": " + detail::counted(counts[FrameKind::cloth], "view") + ", " +
                 detail::counted(plan.frames.size(), "frame"),
        .key = {{MarkShape::dot, scale_colour(0.4), "view of the cloth"},
                {MarkShape::square, kWhite,
                 "white standard, seen " + detail::counted(counts[FrameKind::white], "time") +
                     ", and black trap"}},
        .scale = ColourScale{.low = "first", .high = "last", .words = "order"},
        .joined = true};
    add_left_out(plan, picture);
    double order = 0;
    for (const PlannedFrame &view : views) {
        if (view.kind == FrameKind::cloth)
            picture.marks.push_back(
                {view.directions, MarkShape::dot,
                 scale_colour(order++ / static_cast<double>(counts[FrameKind::cloth])),
                 told(view)});
        if (view.kind == FrameKind::white)
            picture.marks.push_back({view.directions, MarkShape::square, kWhite, told(view)});
    }
    return draw(picture);
}

} // namespace tsuya::lab

#include "left_out_marks.h"

#include <array>
#include <map>
#include <utility>

namespace tsuya::lab {
namespace {

constexpr std::array kPlanColours{"#c0392b", "#8a6d3b", "#5b6ee1", "#444444"};
constexpr std::array kMeasuredColours{"#ff2020", "#ff8c00", "#c000c0", "#0080ff",
                                      "#00a060", "#804000", "#000000", "#a0a000"};

/// Crosses of one reason, and a line of the key.
void add_reason(const std::string &reason, const std::string &colour,
                const std::vector<std::pair<DirectionPair, std::string>> &views,
                HemispherePicture &picture) {
    for (const auto &[directions, told] : views)
        picture.marks.push_back({directions, MarkShape::cross, colour, told});
    picture.key.push_back(
        {MarkShape::cross, colour, "left out, " + reason + ": " + std::to_string(views.size())});
}

} // namespace

void add_left_out(const Plan &plan, HemispherePicture &picture) {
    std::map<std::string, std::vector<std::pair<DirectionPair, std::string>>> reasons;
    for (const LeftOut &view : plan.left_out)
        reasons[reason_of(view)].emplace_back(view.directions, view.why);
    std::size_t i = 0;
    for (const auto &[reason, views] : reasons)
        add_reason(reason, kPlanColours[i++ % kPlanColours.size()], views, picture);
}

void add_left_out(const SessionMeasurement &measured, HemispherePicture &picture) {
    std::map<LeftOutReason, std::vector<std::pair<DirectionPair, std::string>>> reasons;
    for (const LeftOutView &view : measured.left_out)
        reasons[view.reason].emplace_back(view.directions, "view " + std::to_string(view.view) +
                                                               ", " + name_of(view.reason) + ": " +
                                                               view.detail);
    for (const auto &[reason, views] : reasons)
        add_reason(name_of(reason), kMeasuredColours[static_cast<std::size_t>(reason)], views,
                   picture);
}

} // namespace tsuya::lab

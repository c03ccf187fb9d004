#include "tsuya/lab/planning.h"

#include "tsuya/lab/rig_motion.h"
#include "tsuya/lab/session.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/reflectance_file.h"
#include "view_order.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>

namespace tsuya::lab {
namespace {

constexpr double kReferenceTheta = 45 * kDegree;
constexpr double kFinestStep_deg = 0.5; // of few:STEP: 129,000 views without a symmetry
constexpr double kCoarsestStep_deg = 90;

std::string joined(const Error &error) {
    std::string text;
    for (const Problem &problem : error.problems())
        text += (text.empty() ? "" : ", ") + problem.where + ": " + problem.what;
    return text;
}

/// Why the rig cannot take a pair; empty if it can.
std::string obstacle(const RigFile &rig, const DirectionPair &pair) {
    try {
        positions_deg(rig, pair, {});
        return "";
    } catch (const Error &error) {
        return joined(error);
    }
}

/// Beside the light, where a white standard has no gloss, on either side of it.
DirectionPair reference_view(const RigFile &rig, const LightViews &light) {
    std::string why;
    for (const double beside : {90 * kDegree, -90 * kDegree}) {
        const DirectionPair pair{.theta_i = light.theta_i,
                                 .phi_i = light.phi_i,
                                 .theta_r = kReferenceTheta,
                                 .phi_r = light.phi_i + beside};
        why = obstacle(rig, pair);
        if (why.empty())
            return pair;
    }
    throw Error({"the reference view of the white standard cannot be taken: " + why,
                 "light from theta " + std::to_string(std::lround(light.theta_i / kDegree)) +
                     ", phi " + std::to_string(std::lround(light.phi_i / kDegree)) + " degrees",
                 "expected a rig that reaches 45 degrees beside the light"});
}

class Planner {
  public:
    Planner(const RigFile &rig, const PlanRequest &request) : rig_(rig), request_(request) {}

    Plan plan() {
        plan_ = {.symmetry = request_.directions.symmetry,
                 .white = request_.white,
                 .views = request_.views,
                 .rig = request_.rig,
                 .rig_hash = request_.rig.empty() ? "" : file_hash(request_.rig)};
        const std::vector<LightViews> lights = ordered_views(reachable(), rig_);
        if (lights.empty())
            throw Error({"no view is left to be planned", request_.views,
                         plan_.left_out.empty()
                             ? "expected at least one view"
                             : "the first is left out for " + plan_.left_out.front().why});
        add(FrameKind::dark, reference_view(rig_, lights.front()));
        for (const LightViews &light : lights)
            add_light(light, reference_view(rig_, light));
        add(FrameKind::dark, reference_view(rig_, lights.back()));
        return std::move(plan_);
    }

  private:
    std::vector<DirectionPair> reachable() {
        std::vector<DirectionPair> pairs;
        for (const DirectionPair &pair : request_.directions.pairs) {
            const std::string why = obstacle(rig_, pair);
            if (why.empty())
                pairs.push_back(pair);
            else
                plan_.left_out.push_back({.directions = pair, .why = why});
        }
        return pairs;
    }

    void add_light(const LightViews &light, const DirectionPair &reference) {
        add(FrameKind::white, reference);
        add(FrameKind::trap, reference);
        for (std::span<const DirectionPair> rest = light.views; !rest.empty();) {
            const std::size_t count = std::min(rest.size(), request_.white_every);
            if (request_.white == WhiteUse::each_view)
                for (const DirectionPair &pair : rest.first(count))
                    add(FrameKind::white, pair);
            for (const DirectionPair &pair : rest.first(count))
                add(FrameKind::cloth, pair);
            add(FrameKind::white, reference);
            rest = rest.subspan(count);
        }
    }

    void add(FrameKind kind, const DirectionPair &pair) {
        for (const double exposure : rig_.camera.exposures_s)
            plan_.frames.push_back(
                {.kind = kind, .view = view_, .directions = pair, .exposure_s = exposure});
        ++view_;
    }

    const RigFile &rig_;
    const PlanRequest &request_;
    Plan plan_{};
    std::size_t view_ = 0;
};

constexpr std::string_view kFew = "few:";

/// Degrees of `few:STEP`. Throws Error for a step out of range.
double step_of(const std::string &name) {
    double step_deg = 0;
    const char *const end = name.data() + name.size();
    const auto [rest, code] = std::from_chars(name.data() + kFew.size(), end, step_deg);
    if (code != std::errc() || rest != end ||
        !(step_deg >= kFinestStep_deg && step_deg <= kCoarsestStep_deg))
        throw Error({"'" + name + "' is no set of views", "views",
                     "expected few: and a step of 0.5 to 90 degrees, such as few:5"});
    return step_deg;
}

void need_file(const std::string &name) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(name, ignored))
        throw Error({"'" + name + "' is no set of views, and no file", "views",
                     "expected few:STEP such as few:5, paper, or a table of reflectance"});
}

} // namespace

void check_views_name(const std::string &name) {
    if (name.starts_with(kFew))
        step_of(name);
    else if (name != "paper" && !std::filesystem::path(name).has_extension())
        need_file(name);
}

Directions views_named(const std::string &name, std::optional<Symmetry> symmetry) {
    if (name == "paper") {
        Directions directions = paper_directions();
        directions.symmetry = symmetry.value_or(Symmetry::none);
        return directions;
    }
    if (!name.starts_with(kFew)) {
        need_file(name);
        Directions directions = directions_of(read_reflectance_table(name));
        directions.symmetry = symmetry.value_or(directions.symmetry);
        return directions;
    }
    return normal_incidence(step_of(name), symmetry.value_or(Symmetry::half_turn));
}

Plan make_plan(const RigFile &rig, const PlanRequest &request) {
    if (request.white_every == 0)
        throw Error({"is 0", "white_every", "expected at least 1 view"});
    return Planner(rig, request).plan();
}

} // namespace tsuya::lab

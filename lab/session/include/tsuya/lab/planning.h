#pragma once
/// \file
/// From views that are asked for to the plan of a session, and what the session will take.

#include <array>
#include <optional>

#include "tsuya/lab/plan.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// Throws Error for a name that no file could make one of views_named: a step outside 0.5 to 90
/// degrees; a word without an extension that is neither `paper` nor a file.
void check_views_name(const std::string &name);

/// The views of `few:STEP` (light from straight above, every STEP degrees, as far as the symmetry
/// does not repeat them; half-turn where none is given), `paper` (the set of [Takeda]; no symmetry
/// where none is given) or a table's file (its own symmetry where none is given). Throws Error for
/// other names, a step outside 0.5 to 90 degrees, a file that is no table.
Directions views_named(const std::string &name, std::optional<Symmetry> symmetry);

/// What is to be planned.
struct PlanRequest {
    Directions directions{};
    std::string views{};         ///< their name, kept in the plan
    std::filesystem::path rig{}; ///< its file, kept in the plan
    WhiteUse white = WhiteUse::each_light;
    std::size_t white_every = 50; ///< views from one white frame to the next, > 0
};

/// Plans a session. The order:
/// - a dark frame of each exposure, at the beginning and at the end;
/// - the directions of light one after the other; for each a white frame at its reference view,
///   the black trap there, then the views, with a white frame after each `white_every` and at the
///   end. With each_view, blocks of so many views begin with a white frame of each of them;
/// - the views so that the axis that moves slowest moves least, then the next slower one;
/// - every view in each of the camera's exposures, shortest first.
///
/// The reference view lies at 45 degrees from the normal and 90 degrees of azimuth beside the
/// light. Views that the rig cannot reach or where lamp and camera would coincide are left out, and
/// named; pairs that are equal are planned once. Throws Error where no view is left, or the
/// reference view of a light cannot be reached.
Plan make_plan(const RigFile &rig, const PlanRequest &request);

/// What a plan will take.
struct PlanEstimate {
    std::size_t views = 0, frames = 0;
    std::array<std::size_t, kAxes> moves{}; ///< by AxisName
    std::size_t sample_changes = 0;
    int strikes = 1; ///< of the lamp
    Seconds time{0}; ///< with the warm-up
    double disk_mb = 0;
};

/// Adds up the plan's frames, movements and waits, with the times that the rig file states.
PlanEstimate estimate(const Plan &plan, const RigFile &rig);

} // namespace tsuya::lab

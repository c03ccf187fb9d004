#pragma once
/// \file
/// PLAN.jsonl: every frame of a capture session, in the order in which it is taken.

#include <filesystem>
#include <string>
#include <vector>

#include "tsuya/sdk/directions.h"

namespace tsuya::lab {

/// What stands in front of the camera.
enum class FrameKind {
    cloth,
    white, ///< the white standard
    dark,  ///< nothing: the shutter stays shut under a lit lamp
    trap,  ///< a black trap in the place of the cloth: what the room scatters
};

/// As in the file: `cloth`.
const char *name_of(FrameKind kind);

/// Which frames of the white standard a view is divided by.
enum class WhiteUse {
    each_light, ///< one well-known view, at 45 degrees, for each direction of light
    each_view,  ///< one at the directions of each view, as [Takeda] Eq. 2 is printed
};

/// One picture to be taken.
struct PlannedFrame {
    FrameKind kind = FrameKind::cloth;
    /// Frames of one view follow each other and differ by their exposure alone.
    std::size_t view = 0;
    DirectionPair directions{}; ///< of a dark frame: those at which the rig happens to stand
    double exposure_s = 0;      ///< seconds, > 0
    bool operator==(const PlannedFrame &) const = default;
};

/// A view that was asked for and is not planned.
struct LeftOut {
    DirectionPair directions{};
    std::string why{}; ///< in or outside of what the rig can do
    bool operator==(const LeftOut &) const = default;
};

/// The part of `why` without its numbers: `geometry.dead_cone_deg`.
std::string reason_of(const LeftOut &left_out);

/// A whole plan. The number of a frame is its place in `frames`.
struct Plan {
    Symmetry symmetry = Symmetry::none; ///< of the cloth
    WhiteUse white = WhiteUse::each_light;
    std::string views{};         ///< as they were asked for: `few:5`, `paper`, a file's name
    std::filesystem::path rig{}; ///< the rig file that it was made for
    std::string rig_hash{};      ///< file_hash() of that
    std::vector<PlannedFrame> frames{};
    std::vector<LeftOut> left_out{};
    bool operator==(const Plan &) const = default;
};

/// Reads schema `tsuya-plan 1`: a line that describes the plan, then one line for each view that is
/// left out and for each frame. Angles are in degrees in the file and in radians here. Throws Error
/// with file:line of up to 20 problems: no JSON, a key that is missing, unknown or no such value,
/// an angle or exposure out of range, frames out of order.
Plan read_plan(const std::filesystem::path &file);

/// The text of a plan's file. What is read from it is written the same.
std::string plan_text(const Plan &plan);

/// Writes plan_text() through a temporary file. Throws Error naming it.
void write_plan(const Plan &plan, const std::filesystem::path &file);

} // namespace tsuya::lab

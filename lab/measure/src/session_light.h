#pragma once
/// \file
/// The pictures of a session as light: what was read of every view.

#include "tsuya/sdk/progress.h"
#include "view_light.h"

namespace tsuya::lab {

/// All views of a session. What could not be read is in `left_out`, if it is of the cloth.
struct SessionLight {
    std::vector<std::string> colours{};
    std::vector<ViewLight> cloth{}, white{}, trap{};
    std::vector<LeftOutView> left_out{};
    /// Planned views of the white standard that every exposure clips: not in `white`.
    int clipped_white = 0;
    int dark_white = 0; ///< and those that are no brighter than their noise, as of a dead lamp
    /// Views of the standard or the trap whose monitor tells nothing: in neither.
    int without_monitor = 0;
};

/// Reads every counted frame's patches. Throws Error where there is no cloth or no white, frames of
/// other colours, settings out of range; Interrupted.
SessionLight read_session_light(const Session &session, const MeasureSettings &settings,
                                const Progress &progress);

} // namespace tsuya::lab

#pragma once
/// \file
/// How far a session is, for someone who looks from outside.

#include <optional>
#include <string>

#include "tsuya/lab/session.h"

namespace tsuya::lab {

/// What the folder and the logs of its rig report.
struct SessionStatus {
    std::size_t planned = 0, counted = 0, rejected = 0; ///< frames; pictures that were put aside
    int runs = 0;                                       ///< of the program on this session
    std::string running{};                ///< number of the process that works on it; empty: none
    bool lamp_lit = false;                ///< by the journal
    int strikes = 0;                      ///< of the lamp, by the journal
    double lamp_hours = 0;                ///< by the journal
    std::string last{};                   ///< kind of the journal's last event
    std::optional<std::string> latched{}; ///< a fault of the rig that nobody acknowledged
};

/// Looks at a session, also one that is being run; changes nothing. Throws what read_session
/// throws.
SessionStatus session_status(const std::filesystem::path &folder);

} // namespace tsuya::lab

#pragma once
/// \file
/// A capture session on one page.

#include "tsuya/lab/measure_session.h"

namespace tsuya::lab {

/// One HTML file that needs no other: what was run when, with lamp, shutter and frames along the
/// time; the white standard's drift; the parts of every view's error; the table on the hemisphere;
/// what was left out, put aside and failed, and why. Reads the session's journal; throws what
/// read_journal throws.
std::string session_page(const Session &session, const SessionMeasurement &measured);

} // namespace tsuya::lab

#pragma once
/// \file
/// The charts of a session's page, each as SVG.

#include "tsuya/lab/journal.h"
#include "tsuya/lab/measure_session.h"

namespace tsuya::lab {

/// The events of one run of the program.
struct RunEvents {
    std::vector<const JournalEvent *> events{}; ///< begins with the kind `session`

    double begin_s() const { return events.front()->time_s; }
    double end_s() const { return events.back()->time_s; }
};

/// The runs in a journal, in their order. The journal must outlive them.
std::vector<RunEvents> runs_of(const Journal &journal);
std::vector<RunEvents> runs_of(Journal &&) = delete;

/// Lamp, open shutter, and frames by kind along the time of a run, which takes
/// a second or more; faults are lines through all.
std::string timeline(const RunEvents &run, const Plan &plan);

/// The white standard along the time of one lighting of the lamp, relative to its mean for each
/// direction of light. Empty where it has fewer than two readings.
std::string white_chart(const ChannelMeasurement &channel, int strike);

/// The parts of each view's error relative to its value, views in their order.
std::string sigma_chart(const ChannelMeasurement &channel);

/// A part of the errors of views.
struct SigmaPart {
    const char *name;
    const char *colour;
    double MeasuredView::*value;
};
inline constexpr std::array<SigmaPart, 4> kSigmaParts{
    {{"noise", "#1f6fd0", &MeasuredView::noise},
     {"drift", "#1d9a4b", &MeasuredView::drift},
     {"texture", "#d9730d", &MeasuredView::texture},
     {"white", "#9b30c0", &MeasuredView::white}}};

} // namespace tsuya::lab

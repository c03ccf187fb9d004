#pragma once
/// \file
/// Lights the lamp of a session and turns it off, with its times.

#include "session_journal.h"
#include "tsuya/lab/safety.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::lab {

class LampKeeper {
  public:
    /// \param line null: someone switches the lamp by hand
    LampKeeper(const RigLamp &lamp, OutputLine *line, const std::filesystem::path &log,
               SafetyClock &clock, SessionJournal &journal, const Moments &moments);

    /// Lights it and lets it warm up. Throws SessionFault if it may not be lit yet and `wait` is
    /// not set, Interrupted at a stop.
    void light(bool wait, const Progress &progress);
    /// Waits until it has been lit for its shortest time. Throws as light() does.
    void wait_min_on(const Progress &progress);
    /// Notes that the line was driven off.
    void went_out();

    bool lit() const { return log_.state().lit; }
    int strike() const { return log_.state().strikes; }
    double hours() const { return log_.hours_now(); }

  private:
    void sleep(Seconds time, const char *stage, const Progress &progress);
    void note();

    const RigLamp &lamp_;
    OutputLine *line_;
    SafetyClock &clock_;
    SessionJournal &journal_;
    const Moments &moments_;
    LampLog log_;
    std::chrono::nanoseconds lit_at_{0};
};

} // namespace tsuya::lab

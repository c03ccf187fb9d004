#pragma once
/// \file
/// The journal of a running session: stamped, and an end of the session where it cannot be kept.

#include "tsuya/lab/journal.h"
#include "tsuya/lab/lamp_log.h"

namespace tsuya::lab {

class SessionJournal {
  public:
    SessionJournal(const std::filesystem::path &folder, const Moments &moments)
        : writer_(folder / "journal.jsonl"), moments_(moments) {}

    const Journal &before() const { return writer_.before(); }
    double now_s() const { return moments_().time_s; }
    /// Stamps and appends an event. Throws SessionFault if it cannot.
    void note(JournalEvent event);
    /// The same; the event is on the disk when the call returns.
    void note_lasting(JournalEvent event);

  private:
    JournalWriter writer_;
    const Moments &moments_;
};

} // namespace tsuya::lab

#include "session_journal.h"

#include "tsuya/lab/safety.h"

namespace tsuya::lab {

void SessionJournal::note(JournalEvent event) {
    event.time_s = now_s();
    try {
        writer_.append(std::move(event));
    } catch (const Error &error) {
        throw SessionFault(error.problems().front(), false);
    }
}

void SessionJournal::note_lasting(JournalEvent event) {
    note(std::move(event));
    try {
        writer_.sync();
    } catch (const Error &error) {
        throw SessionFault(error.problems().front(), false);
    }
}

} // namespace tsuya::lab

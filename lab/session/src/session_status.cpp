#include "tsuya/lab/session_status.h"

#include "tsuya/lab/safety.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

/// Who holds the journal.
std::string writer_of(const std::filesystem::path &journal) {
    const int descriptor = open(journal.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
        return "";
    const bool free = flock(descriptor, LOCK_SH | LOCK_NB) == 0;
    close(descriptor);
    if (free)
        return "";
    try {
        return read_file(journal.string() + ".pid");
    } catch (const Error &) {
        return "unknown";
    }
}

} // namespace

SessionStatus session_status(const std::filesystem::path &folder) {
    const std::filesystem::path journal = folder / "journal.jsonl";
    const Session session = read_session(folder);
    SessionStatus status{.planned = session.plan.frames.size(),
                         .counted = session.frames.size(),
                         .rejected = session.rejected.size(),
                         .running = writer_of(journal)};
    for (const JournalEvent &event : read_journal(journal).events) {
        status.runs += event.kind == EventKind::session ? 1 : 0;
        status.last = name_of(event.kind);
        if (event.kind != EventKind::lamp)
            continue;
        status.lamp_lit = event.number("on") != 0;
        status.strikes = static_cast<int>(event.number("strike"));
        status.lamp_hours = event.number("hours");
    }
    if (!session.plan.rig.empty())
        status.latched = latched_fault(fault_log_of(session.plan.rig));
    return status;
}

} // namespace tsuya::lab

#pragma once
/// \file
/// journal.jsonl: what happened in a capture session, one JSON object a line, on the disk before
/// the next step begins.

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tsuya::lab {

/// What happened. A frame counts from its `ok` on.
enum class EventKind {
    session, ///< a run of the program began: texts `plan`, `rig` (hashes), `boot`; number `run`
    move,    ///< axes are sent to positions: one number for each, in degrees of the drive
    arrived, ///< all of them are there
    open,    ///< the shutter is about to open (of a dark frame: the exposure begins)
    close,   ///< it is closed again
    file,    ///< a picture has come: text `file`, number `bytes`
    ok,      ///< it passed every check: texts `file`, `hash`; numbers as of CountedFrame
    reject,  ///< it did not, and was moved: texts `file`, `why`
    lamp,    ///< number `on` 1 or 0, `strike`, `hours`
    fault,   ///< text `why`; number `safety` 1 for one that turned the lamp off
    note,    ///< anything else: text `what`
};

/// As in the file: `arrived`.
const char *name_of(EventKind kind);

/// One line of the journal.
struct JournalEvent {
    EventKind kind = EventKind::note;
    std::optional<std::size_t> frame{}; ///< its number in the plan
    std::map<std::string, std::string> texts{};
    std::map<std::string, double> numbers{};
    std::uint64_t seq = 0; ///< from 0, without a gap
    double time_s = 0;     ///< seconds since 1970
    bool operator==(const JournalEvent &) const = default;

    /// Empty where there is none.
    std::string text(const std::string &key) const;
    /// 0 where there is none.
    double number(const std::string &key) const;
};

/// A journal as it was read.
struct Journal {
    std::vector<JournalEvent> events{};
    /// Bytes of whole lines. What follows them was cut off while it was written, and is no part of
    /// the journal.
    std::uint64_t whole_bytes = 0;
    bool torn = false; ///< whether there is such a rest
};

/// The line of an event, without its line break: its checksum `crc` is the last key, a CRC-32 in
/// hexadecimal of all that stands before it in the line.
std::string journal_line(const JournalEvent &event);

/// Reads a journal. A last line without a line break is dropped as torn. Throws Error with
/// file:line if the file cannot be read, or a line before has a wrong checksum, a `seq` that does
/// not follow the one before, or an unknown kind or key.
Journal read_journal(const std::filesystem::path &file);

/// Appends events to a journal, for one process at a time.
class JournalWriter {
  public:
    /// Opens the file, makes it where there is none, drops a torn last line, and locks it. Throws
    /// what read_journal throws, and Error naming the file if it cannot be written or another
    /// process has it, with that process's number.
    explicit JournalWriter(std::filesystem::path file);
    ~JournalWriter();
    JournalWriter(const JournalWriter &) = delete;
    JournalWriter &operator=(const JournalWriter &) = delete;

    /// What stood there when it was opened.
    const Journal &before() const { return before_; }
    /// Gives the event its `seq` and appends it. Throws Error naming the file, which then ends with
    /// the line before.
    void append(JournalEvent event);
    /// Returns when all that was appended is on the disk. Throws Error naming the file.
    void sync();

  private:
    void lock();
    [[noreturn]] void fail(const std::string &what, int code) const;

    std::filesystem::path file_;
    Journal before_{};
    int descriptor_ = -1;
    std::uint64_t next_seq_ = 0, bytes_ = 0;
};

/// Makes the names in a folder as lasting as the files. Throws Error naming it.
void sync_folder(const std::filesystem::path &folder);

/// Makes a file's bytes lasting. Throws Error naming it.
void sync_file(const std::filesystem::path &file);

} // namespace tsuya::lab

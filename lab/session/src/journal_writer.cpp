#include "tsuya/lab/journal.h"

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

/// The process that holds a lock says so in a file beside it.
std::filesystem::path owner_file(const std::filesystem::path &file) {
    return file.string() + ".pid";
}

std::string owner_of(const std::filesystem::path &file) {
    try {
        return read_file(owner_file(file));
    } catch (const Error &) {
        return "unknown";
    }
}

void sync_path(const std::filesystem::path &path, int flags) {
    const int descriptor = open(path.c_str(), flags | O_CLOEXEC);
    const bool good = descriptor >= 0 && fsync(descriptor) == 0;
    const int code = errno;
    if (descriptor >= 0)
        close(descriptor);
    if (!good)
        throw Error({std::string("cannot be made lasting on the disk: ") + std::strerror(code),
                     path.string(), accepted_for_writing(code)});
}

} // namespace

JournalWriter::JournalWriter(std::filesystem::path file) : file_(std::move(file)) {
    descriptor_ = open(file_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor_ < 0)
        fail("cannot be opened", errno);
    try {
        lock();
        before_ = read_journal(file_);
        if (before_.torn && ftruncate(descriptor_, static_cast<off_t>(before_.whole_bytes)) != 0)
            fail("its torn line cannot be dropped", errno);
        next_seq_ = before_.events.size();
        bytes_ = before_.whole_bytes;
        sync_folder(std::filesystem::absolute(file_).parent_path());
    } catch (...) {
        close(std::exchange(descriptor_, -1));
        throw;
    }
}

JournalWriter::~JournalWriter() {
    std::error_code ignored;
    std::filesystem::remove(owner_file(file_), ignored);
    close(descriptor_);
}

void JournalWriter::lock() {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) != 0)
        throw Error({"another process writes it: " + owner_of(file_), file_.string(),
                     "expected one run at a time"});
    write_file(owner_file(file_), std::to_string(getpid()));
}

void JournalWriter::fail(const std::string &what, int code) const {
    throw Error({what + ": " + std::strerror(code), file_.string(), accepted_for_writing(code)});
}

void JournalWriter::append(JournalEvent event) {
    event.seq = next_seq_;
    const std::string line = journal_line(event) + "\n";
    for (std::size_t done = 0; done < line.size();) {
        const ssize_t wrote = write(descriptor_, line.data() + done, line.size() - done);
        if (wrote < 0 && errno == EINTR)
            continue;
        if (wrote < 0) {
            const int code = errno;
            // Where even this fails, the next reader drops the rest as torn.
            [[maybe_unused]] const int cut = ftruncate(descriptor_, static_cast<off_t>(bytes_));
            fail("the event cannot be written", code);
        }
        done += static_cast<std::size_t>(wrote);
    }
    bytes_ += line.size();
    ++next_seq_;
}

void JournalWriter::sync() {
    if (fdatasync(descriptor_) != 0)
        fail("cannot be made lasting on the disk", errno);
}

void sync_folder(const std::filesystem::path &folder) { sync_path(folder, O_RDONLY | O_DIRECTORY); }

void sync_file(const std::filesystem::path &file) { sync_path(file, O_RDONLY); }

} // namespace tsuya::lab

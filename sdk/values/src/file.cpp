#include "tsuya/sdk/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include <fcntl.h>
#include <unistd.h>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// The name of an open file in the system's own folder.
std::string name_of(int descriptor) { return "/proc/self/fd/" + std::to_string(descriptor); }

} // namespace

std::string read_file(const std::filesystem::path &file) {
    std::error_code code;
    if (std::filesystem::is_directory(file, code))
        throw Error({"it is a folder", file.string(), "expected a file"});
    std::ifstream in(file, std::ios::binary);
    if (!in)
        throw Error({std::string("the file cannot be opened: ") + std::strerror(errno),
                     file.string(), "expected a file that may be read"});
    if (std::filesystem::is_character_file(file, code) ||
        std::filesystem::is_block_file(file, code))
        throw Error({"it is a device", file.string(), "expected a file or a pipe"});
    std::string bytes{std::istreambuf_iterator<char>(in), {}};
    if (in.bad())
        throw Error({"the file cannot be read", file.string(), "expected a file that may be read"});
    return bytes;
}

std::filesystem::path temporary_name(const std::filesystem::path &file) {
    std::filesystem::path name = file;
    name.replace_filename("." + file.stem().string() + "." + std::to_string(getpid()) + ".part" +
                          file.extension().string());
    return name;
}

std::string accepted_for_writing(int code) {
    switch (code) {
    case ENOSPC:
    case EDQUOT:
        return "expected space on the disk";
    case EFBIG:
        return "expected a file system, and a limit, that allow a file of this size";
    case ENAMETOOLONG:
        return "expected a shorter name";
    default:
        return "expected a folder that exists and may be written to";
    }
}

void replace_file(const std::filesystem::path &temporary, const std::filesystem::path &file) {
    std::error_code code;
    std::filesystem::rename(temporary, file, code);
    if (!code)
        return;
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw Error({"the file cannot be written: " + code.message(), file.string(),
                 accepted_for_writing(code.value())});
}

FileReplacement::FileReplacement(std::filesystem::path file)
    : file_(std::move(file)), part_(temporary_name(file_)) {
    open();
}

FileReplacement::~FileReplacement() {
    out_.close();
    if (unnamed_ >= 0)
        close(unnamed_);
    if (committed_)
        return;
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
}

void FileReplacement::open() {
    const std::filesystem::path folder = file_.parent_path();
    unnamed_ =
        ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    if (unnamed_ >= 0) {
        out_.open(name_of(unnamed_), std::ios::binary);
        if (out_)
            return;
        close(unnamed_); // no /proc
        unnamed_ = -1;
    }
    errno = 0;
    out_.open(part_, std::ios::binary);
    if (!out_)
        fail(errno);
}

// No system call puts a file without a name in the place of another, so it gets the temporary one.
void FileReplacement::give_name() {
    if (unnamed_ < 0)
        return;
    unlink(part_.c_str()); // of a process that had this number before
    if (linkat(AT_FDCWD, name_of(unnamed_).c_str(), AT_FDCWD, part_.c_str(), AT_SYMLINK_FOLLOW) !=
        0)
        fail(errno);
}

void FileReplacement::write(std::string_view bytes) {
    errno = 0;
    if (!out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        fail(errno);
}

void FileReplacement::commit() {
    errno = 0;
    out_.close();
    if (!out_)
        fail(errno);
    give_name();
    committed_ = true; // the name is taken, or removed by replace_file
    replace_file(part_, file_);
}

void FileReplacement::fail(int code) {
    throw Error({std::string("the file cannot be written: ") + std::strerror(code), file_.string(),
                 accepted_for_writing(code)});
}

void write_file(const std::filesystem::path &file, std::string_view bytes) {
    FileReplacement replacement(file);
    replacement.write(bytes);
    replacement.commit();
}

} // namespace tsuya

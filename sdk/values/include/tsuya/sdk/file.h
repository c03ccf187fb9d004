#pragma once
/// \file
/// Whole files: read at once, written by atomic replacement.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace tsuya {

/// The bytes of a file. Throws Error naming it if it cannot be read.
std::string read_file(const std::filesystem::path &file);

/// Replaces a file: what stood there stays until all is written. Throws Error naming it, with the
/// system's reason, such as a disk without space.
void write_file(const std::filesystem::path &file, std::string_view bytes);

/// Atomic replacement of a file that is written piece by piece: under a temporary name beside it,
/// renamed when it is complete. Without `commit` nothing is left. Until then the temporary file has
/// no name where the file system can do that (O_TMPFILE), so that a process that is killed leaves
/// nothing either; elsewhere it leaves `.NAME.PID.part.EXTENSION`.
class FileReplacement {
  public:
    /// Throws Error naming the file if nothing can be written beside it.
    explicit FileReplacement(std::filesystem::path file);
    ~FileReplacement();
    FileReplacement(const FileReplacement &) = delete;
    FileReplacement &operator=(const FileReplacement &) = delete;

    /// Throws Error naming the file.
    void write(std::string_view bytes);
    /// The file stands under its name. Throws Error naming it; what stood there before stays then.
    void commit();

  private:
    void open();
    void give_name();
    [[noreturn]] void fail(int code);

    std::filesystem::path file_, part_;
    int unnamed_ = -1; ///< descriptor of a file without a name
    std::ofstream out_;
    bool committed_ = false;
};

/// The temporary name beside `file` that a writer renames to it when it is complete. Keeps the
/// extension, which picture writers look at.
std::filesystem::path temporary_name(const std::filesystem::path &file);

/// Puts a complete temporary file in the place of `file`. Throws Error naming it, with the
/// temporary file removed.
void replace_file(const std::filesystem::path &temporary, const std::filesystem::path &file);

/// What an Error about a file that cannot be written accepts, by the system's error number: what
/// would help differs between a disk without space and a folder that is not there.
std::string accepted_for_writing(int code);

} // namespace tsuya

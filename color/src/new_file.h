#pragma once
/// \file
/// A file that another library writes, and that appears under its name only when it is complete.

#include <filesystem>

namespace tsuya {

/// Holds a temporary name beside `target` with the same extension; the destructor removes what is
/// there unless `commit` renamed it.
class NewFile {
  public:
    /// Throws Error at `target` if its folder does not exist or `target` is a folder.
    explicit NewFile(std::filesystem::path target);
    ~NewFile();
    NewFile(const NewFile &) = delete;
    NewFile &operator=(const NewFile &) = delete;

    const std::filesystem::path &temporary() const { return temporary_; }
    /// Renames the temporary file to the target. Throws Error at the target if that fails.
    void commit();

  private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
};

} // namespace tsuya

#pragma once
/// \file
/// Places for results, tried before the long work that makes them.

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace tsuya::scene {

/// Tries whether a file can be written or replaced, with an empty temporary file in its folder or,
/// where that is missing, in the first one above that is there. Throws Error at the path unless it
/// ends in one of `extensions` (such as `.exr`; empty: any), if it is a folder, and where the
/// temporary file cannot be made.
void check_output_file(const std::filesystem::path &file,
                       const std::vector<std::string> &extensions = {});

/// The same, and creates the folder of the file with parents where they are missing.
void prepare_output_file(const std::filesystem::path &file,
                         const std::vector<std::string> &extensions = {});

/// What the files of a frame end with, before their extension: `-0000`, `-0001`, ...
std::string frame_suffix(std::size_t frame);

/// Throws Error unless results can be written into a folder or, where it is missing, it can be
/// created.
void check_output_folder(const std::filesystem::path &folder);

/// A folder for results, created where it is missing. What was created and is still empty at the
/// end is removed again.
class OutputFolder {
  public:
    /// Throws Error as check_output_folder, and where the folder cannot be created.
    explicit OutputFolder(const std::filesystem::path &folder);
    ~OutputFolder();
    OutputFolder(const OutputFolder &) = delete;
    OutputFolder &operator=(const OutputFolder &) = delete;

  private:
    std::filesystem::path folder_;
    std::size_t created_ = 0; ///< folders, this one and those around it
};

} // namespace tsuya::scene

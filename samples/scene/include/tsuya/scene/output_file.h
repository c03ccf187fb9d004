#pragma once
/// \file
/// Places for results, tried before the long work that makes them.

#include <filesystem>
#include <string>
#include <vector>

namespace tsuya::scene {

/// Looks whether a file can be written or replaced, and changes nothing. Throws Error at the path
/// unless it ends in one of `extensions` (such as `.exr`; empty: any); and if it is a folder, or
/// its folder may not be written to or, where it is missing, created.
void check_output_file(const std::filesystem::path &file,
                       const std::vector<std::string> &extensions = {});

/// The same, and creates the folder of the file with parents where they are missing.
void prepare_output_file(const std::filesystem::path &file,
                         const std::vector<std::string> &extensions = {});

/// Throws Error unless results can be written into a folder or, where it is missing, it can be
/// created.
void check_output_folder(const std::filesystem::path &folder);

/// The same, and creates the folder.
void prepare_output_folder(const std::filesystem::path &folder);

} // namespace tsuya::scene

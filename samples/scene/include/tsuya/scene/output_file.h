#pragma once
/// \file
/// Places for results, tried before the long work that makes them.

#include <filesystem>
#include <string>
#include <vector>

namespace tsuya::scene {

/// Makes sure that a file can be written or replaced: creates its folder with parents where they
/// are missing. The file itself is not touched. Throws Error at the path, with nothing created,
/// unless it ends in one of `extensions` (such as `.exr`; empty: any); and if it is a folder, or
/// its folder cannot be created or written to.
void prepare_output_file(const std::filesystem::path &file,
                         const std::vector<std::string> &extensions = {});

/// The same for a folder that results go into.
void prepare_output_folder(const std::filesystem::path &folder);

} // namespace tsuya::scene

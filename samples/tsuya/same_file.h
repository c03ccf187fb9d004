#pragma once
/// \file
/// Two names of one file.

#include <filesystem>

namespace tsuya::program {

/// Whether both names lead to one file, also through links, or would if it were there.
bool is_same_file(const std::filesystem::path &a, const std::filesystem::path &b);

} // namespace tsuya::program

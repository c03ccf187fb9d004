#pragma once
/// \file
/// Whole files, read and written without leaving halves behind.

#include <filesystem>
#include <string>
#include <string_view>

namespace tsuya {

/// The bytes of a file. Throws Error naming it if it cannot be read.
std::string read_file(const std::filesystem::path &file);

/// Replaces a file: writes to a temporary name beside it, then renames. Throws Error naming it.
void write_file(const std::filesystem::path &file, std::string_view bytes);

/// The temporary name beside `file` that a writer renames to it when it is complete. Keeps the
/// extension, which picture writers look at.
std::filesystem::path temporary_name(const std::filesystem::path &file);

} // namespace tsuya

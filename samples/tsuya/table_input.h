#pragma once
/// \file
/// A table of reflectance as the input of a command.

#include <filesystem>

#include "console.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya::program {

/// Reads TABLE.csv and warns of what was mended and of what is odd, one warning a finding and
/// channel. Throws Error as read_reflectance_file.
ReflectanceFile read_table(const std::filesystem::path &file, Console &console);

/// The channel of that name, without a name the only one. Throws Error also where there is none,
/// with the names of those that are there.
ReflectanceTable read_channel(const std::filesystem::path &file, const std::string &name,
                              Console &console);

/// The same for a file with one column of values. Throws Error for a file with channels too.
ReflectanceTable read_single_table(const std::filesystem::path &file, Console &console);

} // namespace tsuya::program

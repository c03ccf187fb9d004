#pragma once
/// \file
/// The help of the program and of its commands.

#include <span>
#include <string>

#include "command.h"

namespace tsuya::program {

/// The table with its groups, and the options that every command has.
std::string help_of_program(std::span<const CommandEntry> table, const Options &common);

/// The commands of a group, with the example of the first.
std::string help_of_group(const CommandEntry &group, std::span<const CommandEntry> commands,
                          const Options &first);

std::string help_of_command(const CommandEntry &entry, const Options &options);

} // namespace tsuya::program

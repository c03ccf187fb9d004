#pragma once
/// \file
/// Values that a rig file has in several places.

#include "tsuya/sdk/document.h"

#include <set>

namespace tsuya::lab {

/// The place of a name in the list.
std::optional<std::size_t> index_of(const std::string &name, const std::vector<std::string> &known);

/// The index of the name at the key; 0 where the key is absent. Notes a name that is unknown, and
/// an absent key that is required.
std::size_t read_choice(const Section &section, const char *key,
                        const std::vector<std::string> &names, bool required = false);

/// A table that must be there: a problem is noted where it is not.
std::optional<Section> required_section(const Section &root, const char *key);

/// The key `command`: program and arguments. A placeholder such as `{file}` that is not known, or
/// one that is needed and not there, is noted.
std::vector<std::string> read_command(const Section &section, const std::set<std::string> &known,
                                      const std::set<std::string> &needed);

} // namespace tsuya::lab

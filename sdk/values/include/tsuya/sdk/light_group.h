#pragma once
/// \file
/// Names of light groups: of parts of the transport that get a lamp each.

#include <string>

namespace tsuya {

/// Throws Error naming `where` for a name that no light group can have in a picture file and in
/// `GROUP=LAMP`: it has 1 to 64 bytes, without '=' and control characters.
void check_light_group(const std::string &name, const std::string &where);

} // namespace tsuya

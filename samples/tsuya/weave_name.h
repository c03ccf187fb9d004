#pragma once
// Weaves as they are named on the command line.

#include <filesystem>
#include <string>

#include "tsuya/lab/weave.h"

namespace tsuya::program {

/// The name is that of WEAVE.toml or DRAFT.wif, and of no preset.
inline bool names_weave_file(const std::string &name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    std::error_code code;
    return extension == ".toml" || extension == ".wif" || std::filesystem::exists(name, code);
}

/// WEAVE.toml, DRAFT.wif or a preset. Throws Error as read_weave and lab::weave.
inline lab::Weave weave_named(const std::string &name) {
    return names_weave_file(name) ? lab::read_weave(name) : lab::weave(name);
}

/// Throws Error for a name that is neither a file's nor a preset's. None at all is left to others.
inline void check_weave_name(const std::string &name) {
    if (!name.empty() && !names_weave_file(name))
        lab::weave(name);
}

} // namespace tsuya::program

#pragma once
// Weaves as they are named on the command line.

#include <filesystem>
#include <string>

#include "tsuya/lab/weave.h"

namespace tsuya::program {

/// WEAVE.toml, DRAFT.wif or a preset. Throws Error as read_weave and lab::weave.
inline lab::Weave weave_named(const std::string &name) {
    const std::string extension = std::filesystem::path(name).extension().string();
    const bool is_file =
        extension == ".toml" || extension == ".wif" || std::filesystem::exists(name);
    return is_file ? lab::read_weave(name) : lab::weave(name);
}

} // namespace tsuya::program

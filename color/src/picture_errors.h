#pragma once
/// \file
/// Errors of picture files that the library and its modules share.

#include <filesystem>
#include <string>

#include "tsuya/sdk/error.h"

namespace tsuya {

/// Throws Error unless a path has the extension of a format.
inline void check_extension(const std::filesystem::path &path, const std::string &extension) {
    if (path.extension() != extension)
        throw Error(
            {"the file does not end in " + extension, path.string(), "expected NAME" + extension});
}

/// The error of a picture that a library refuses.
[[noreturn]] inline void fail_encoding(const std::filesystem::path &path,
                                       const std::string &cause) {
    throw Error({"cannot encode the picture: " + cause, path.string(),
                 "expected a picture that the format can hold"});
}

} // namespace tsuya

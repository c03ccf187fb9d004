#pragma once
/// \file
/// Numbers of things in messages.

#include <cstddef>
#include <string>

namespace tsuya::detail {

/// `1 value`, `3 values`.
/// \param what one of them, a noun whose plural ends in s
inline std::string counted(std::size_t n, const std::string &what) {
    return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

} // namespace tsuya::detail

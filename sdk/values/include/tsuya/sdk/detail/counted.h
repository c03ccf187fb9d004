#pragma once
/// \file
/// Numbers of things in messages.

#include <concepts>
#include <string>

namespace tsuya::detail {

/// `1 vertex lies`, `3 vertices lie`.
std::string counted(std::integral auto n, const std::string &one, const std::string &many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}

/// `1 value`, `3 values`.
/// \param what one of them, a noun whose plural ends in s
std::string counted(std::integral auto n, const std::string &what) {
    return counted(n, what, what + "s");
}

} // namespace tsuya::detail

#pragma once
/// \file
/// Names in any case.

#include <cctype>
#include <string>
#include <string_view>

namespace tsuya {

/// The text with A to Z in lower case.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char &c : result)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

} // namespace tsuya

#pragma once
/// \file
/// Numbers as words of messages, commands and pictures.

#include <array>
#include <charconv>
#include <string>

namespace tsuya::lab {

/// A number with at most `digits` significant digits and without zeros at its end, whatever the
/// locale: `0.1`, `45`, `1e-06`.
inline std::string number_text(double value, int digits = 6) {
    std::array<char, 64> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::general, digits);
    return {text.data(), end.ptr};
}

} // namespace tsuya::lab

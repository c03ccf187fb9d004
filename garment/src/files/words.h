#pragma once
/// \file
/// Lines and words of a text.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya::garment {

/// Takes the next line off `text`.
inline std::string_view take_line(std::string_view &text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
}

/// Takes the next word off `line`; empty at its end.
inline std::string_view take_word(std::string_view &line) {
    constexpr std::string_view kBlanks = " \t\r";
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    const std::string_view word = line.substr(0, end);
    line.remove_prefix(end);
    return word;
}

/// All words of a line.
inline std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line))
        words.push_back(word);
    return words;
}

/// A word for a message, in quotes: the start of a long one.
inline std::string in_quotes(std::string_view word) {
    constexpr std::size_t kShown = 40;
    const bool whole = word.size() <= kShown;
    return "'" + std::string(word.substr(0, kShown)) + (whole ? "'" : "...'");
}

} // namespace tsuya::garment

#pragma once
/// \file
/// Splits a text into what a compiler reads and what a person reads.

#include <string>
#include <string_view>

namespace tsuya::project {

/// Both halves of a C++ text, each with the lines of the original.
struct SplitSource {
    std::string code{};     ///< without comments; string literals are empty, but not of #include
    std::string comments{}; ///< without code and without the marks that start a comment
};

/// Knows line and block comments, string, character and raw string literals, and 1'000.
SplitSource split_cpp(std::string_view text);

/// Only what follows a `#` that starts a line or a word, with the lines of the original.
std::string hash_comments(std::string_view text);

/// Markdown without fenced blocks, `code spans` and HTML comments, with the lines of the original.
std::string markdown_prose(std::string_view text);

} // namespace tsuya::project

#pragma once
/// \file
/// Counts that a file declares, held against the bytes that it has, and numbers written as text.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tsuya::garment {

/// A count in text. Throws Error naming `where` for any other word.
std::uint64_t parse_count(std::string_view word, const std::string &where);

/// Throws Error naming `where` if `count` entries of at least `bytes_each` are more than `bytes`.
void check_count(std::uint64_t count, std::uint64_t bytes_each, std::uint64_t bytes,
                 const std::string &where);

/// The number that is the whole word, `nan` and `inf` too; nullopt for any other word.
std::optional<double> parse_number(std::string_view word);

/// A number for a message: `-1`, `1.5`, `nan`.
std::string number_text(double number);

} // namespace tsuya::garment

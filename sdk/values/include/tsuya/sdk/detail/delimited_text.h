#pragma once
/// \file
/// Lines of fields, as spreadsheets and instruments write them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tsuya::detail {

/// A field without quotes and blanks at its ends, and the column, from 1, where it begins.
struct DelimitedField {
    std::string text{};
    std::size_t column = 1;
};

/// The text without blanks at its ends.
std::string_view without_blanks(std::string_view text);

/// The first of ';', tab and ',' that a line has outside quotes; ' ' where it has none.
char find_separator(std::string_view line);

/// The fields between separators. Quotes keep a separator inside; two of them in quotes are one.
/// Any number of blanks part fields where the separator is ' '.
std::vector<DelimitedField> split_fields(std::string_view line, char separator);

/// Reads numbers whose decimals follow a point or a comma, one or the other in all of them.
class DecimalReader {
  public:
    /// None for what is no finite number. Numbers too small for a double are 0.
    std::optional<double> read(std::string_view text);
    /// The last text had a comma where earlier ones had a point, or the other way.
    bool mixed() const { return mixed_; }

  private:
    char mark_ = 0; ///< before the decimals; 0: none so far
    bool mixed_ = false;
};

} // namespace tsuya::detail

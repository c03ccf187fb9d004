#include "tsuya/sdk/detail/delimited_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace tsuya::detail {
namespace {

constexpr std::string_view kBlank = " \t\r";

// Takes a field in quotes off the front of `rest`.
std::string take_quoted(std::string_view &rest) {
    std::string text;
    rest.remove_prefix(1);
    while (!rest.empty()) {
        const char c = rest.front();
        rest.remove_prefix(1);
        if (c != '"') {
            text += c;
        } else if (rest.starts_with('"')) {
            text += c;
            rest.remove_prefix(1);
        } else {
            break;
        }
    }
    return text;
}

} // namespace

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == text.npos)
        return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

char find_separator(std::string_view line) {
    std::string outside;
    bool quoted = false;
    for (const char c : line)
        if (c == '"')
            quoted = !quoted;
        else if (!quoted)
            outside += c;
    const std::string_view content = without_blanks(outside);
    for (const char separator : {';', '\t', ','})
        if (content.find(separator) != content.npos)
            return separator;
    return ' ';
}

std::vector<DelimitedField> split_fields(std::string_view line, char separator) {
    const std::string_view blank = separator == '\t' ? std::string_view(" \r") : kBlank;
    std::vector<DelimitedField> fields;
    std::string_view rest = line;
    while (true) {
        rest.remove_prefix(std::min(rest.find_first_not_of(blank), rest.size()));
        if (rest.empty() && separator == ' ')
            return fields;
        DelimitedField field{.column = line.size() - rest.size() + 1};
        if (rest.starts_with('"'))
            field.text = take_quoted(rest);
        const std::size_t end = std::min(
            separator == ' ' ? rest.find_first_of(kBlank) : rest.find(separator), rest.size());
        field.text += without_blanks(rest.substr(0, end));
        fields.push_back(std::move(field));
        if (end == rest.size())
            return fields;
        rest.remove_prefix(end + 1);
    }
}

std::optional<double> DecimalReader::read(std::string_view text) {
    std::string digits(text.substr(text.starts_with('+') ? 1 : 0));
    const std::size_t at = digits.find_first_of(".,");
    if (at != digits.npos) {
        const char mark = std::exchange(digits[at], '.');
        mixed_ = mark_ != 0 && mark != mark_;
        mark_ = mark_ == 0 ? mark : mark_;
        if (mixed_)
            return std::nullopt;
    }
    double value = 0;
    const char *const last = digits.data() + digits.size();
    const auto [end, code] = std::from_chars(digits.data(), last, value);
    if (end != last)
        return std::nullopt;
    const bool small = digits.find("e-") != digits.npos || digits.find("E-") != digits.npos;
    if (code == std::errc::result_out_of_range && small)
        return 0;
    return code == std::errc{} && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

} // namespace tsuya::detail

#include "files/declared_count.h"

#include <charconv>
#include <cstdlib>
#include <sstream>

#include "files/words.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {

std::uint64_t parse_count(std::string_view word, const std::string &where) {
    std::uint64_t count = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), count);
    if (error != std::errc{} || stop != word.data() + word.size())
        throw Error({in_quotes(word) + " is no count", where, "expected a number"});
    return count;
}

void check_count(std::uint64_t count, std::uint64_t bytes_each, std::uint64_t bytes,
                 const std::string &where) {
    if (bytes_each > 0 && count > bytes / bytes_each)
        throw Error({detail::counted(count, "entry is", "entries are") + " declared and " +
                         detail::counted(bytes, "byte is", "bytes are") + " left",
                     where, "expected no more than the file holds"});
}

std::optional<double> parse_number(std::string_view word) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range) // too small becomes 0, too large infinity
        value = std::strtod(std::string(word).c_str(), nullptr);
    else if (error != std::errc{})
        return std::nullopt;
    return stop == word.data() + word.size() ? std::optional(value) : std::nullopt;
}

std::string number_text(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

} // namespace tsuya::garment

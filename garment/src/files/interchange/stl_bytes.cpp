#include "files/interchange/stl_bytes.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

constexpr std::size_t kTitleBytes = 80, kHeaderBytes = 84, kFacetBytes = 50;
constexpr const char *kSpace = " \t\r\n\v\f";

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Whether the text from `at` on begins with a word in any case.
bool has_word(const std::string &text, std::size_t at, std::string_view word) {
    return text.size() - at >= word.size() &&
           std::equal(word.begin(), word.end(), text.begin() + static_cast<std::ptrdiff_t>(at),
                      [](char a, char b) { return a == lower(b); });
}

bool is_text(const std::string &bytes) {
    const std::size_t start = bytes.find_first_not_of(kSpace);
    return start != std::string::npos && has_word(bytes, start, "solid") &&
           bytes.find('\0') == std::string::npos;
}

/// All but the names that follow `solid` and `endsolid`.
void lower_keywords(std::string &text) {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::size_t word = std::min(text.find_first_not_of(kSpace, at), end);
        std::size_t stop = end;
        for (const std::string_view named : {"solid", "endsolid"})
            if (has_word(text, word, named))
                stop = word + named.size();
        for (std::size_t i = word; i < stop; ++i)
            text[i] = lower(text[i]);
        at = end + 1;
    }
}

} // namespace

std::string stl_bytes(std::string bytes, const std::string &where) {
    const std::string neither = "the file is no text STL, which begins with 'solid', and ";
    std::uint32_t count = 0;
    std::uint64_t size = 0;
    if (bytes.size() >= kHeaderBytes) {
        std::memcpy(&count, bytes.data() + kTitleBytes, sizeof count);
        size = kHeaderBytes + kFacetBytes * std::uint64_t{count};
        // Characters of a text in its place would count 150 million facets at the least
        if (count > 0 && size <= bytes.size()) {
            bytes.resize(size);
            return bytes;
        }
    }
    if (is_text(bytes)) {
        lower_keywords(bytes);
        return bytes;
    }
    if (bytes.size() < kHeaderBytes)
        throw Error(
            {neither + "too short for a binary one", where,
             "expected a header of 84 bytes, where it has " + std::to_string(bytes.size())});
    throw Error({neither + "as a binary one its header counts " + detail::counted(count, "facet") +
                     ", but it has " + std::to_string(bytes.size()) + " bytes",
                 where,
                 count > 0 ? "expected " + std::to_string(size) + " bytes for this count"
                           : std::string("expected a mesh with faces")});
}

} // namespace tsuya::garment

// Text of any origin: marks, UTF-16, line ends, national code pages.

#include "tsuya/sdk/text.h"

#include <gtest/gtest.h>

#include "tsuya/sdk/error.h"

namespace tsuya::test {
namespace {

using namespace std::string_view_literals;

// The text of bytes that come in blocks of `step`.
std::string decoded(std::string_view bytes, std::size_t step) {
    TextDecoder decoder("t");
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += step)
        decoder.decode(bytes.substr(at, step), text);
    decoder.finish(text);
    return text;
}

std::string utf16(std::u16string_view text, bool little) {
    std::string bytes;
    for (const char16_t unit : text) {
        const char low = static_cast<char>(unit & 0xFF), high = static_cast<char>(unit >> 8);
        bytes += {little ? low : high, little ? high : low};
    }
    return bytes;
}

TEST(Text, IsTheSameInBlocksOfAnySize) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", ""},
        {"a", "a"},
        {"plain\n", "plain\n"},
        {"\xEF\xBB\xBFv 0", "v 0"},
        {"\xEF\xBB\xBF", ""},
        {"a\rb\r\nc\n\rd\r", "a\nb\nc\n\nd\n"},
        {"\xC3\xA9 \xE8\x89\xB6 \xF0\x9F\x91\x97", "\xC3\xA9 \xE8\x89\xB6 \xF0\x9F\x91\x97"},
        {utf16(u"\uFEFFa\r\né艶\U0001F457\r", true), "a\né艶\U0001F457\n"},
        {utf16(u"\uFEFFa\r\né艶\U0001F457\r", false), "a\né艶\U0001F457\n"},
        {utf16(u"v 1", true), "v 1"},
        {utf16(u"v 1", false), "v 1"},
        {utf16(u"\uFEFFab", true) + "c", "ab\uFFFD"},
        {std::string(1000, 'x') + "\r" + std::string(1000, 'y'),
         std::string(1000, 'x') + "\n" + std::string(1000, 'y')}};
    for (const auto &[bytes, text] : cases)
        for (const std::size_t step : {1, 2, 3, 5, 64, 10000})
            EXPECT_EQ(decoded(bytes, step), text) << "step " << step << " of " << bytes;
}

TEST(Text, BytesOfACodePageAreEscaped) {
    // Korean, as in CP949; Latin 1; a character of Shift JIS that ends in a backslash
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"g \xBE\xD5\xC6\xC7\n", "g \\xBE\\xD5\\xC6\\xC7\n"},
        {"45\xB0", "45\\xB0"},
        {"g \x95\x5C\nv", "g \\x95\\x5C\nv"},
        {"\xC3", "\\xC3"},                             // a character without its end
        {"\xE8\x89y", "\\xE8\\x89y"},                  // cut short
        {"\xC0\xAF", "\\xC0\\xAF"},                    // overlong
        {"\xED\xA0\x80", "\\xED\\xA0\\x80"},           // half of a surrogate pair
        {"\xF4\x90\x80\x80", "\\xF4\\x90\\x80\\x80"}}; // beyond U+10FFFF
    for (const auto &[bytes, text] : cases)
        for (const std::size_t step : {1, 2, 10000})
            EXPECT_EQ(decoded(bytes, step), text) << "step " << step;
}

TEST(Text, HalvesOfSurrogatePairsAreReplaced) {
    EXPECT_EQ(decoded(utf16(std::u16string{0xFEFF, 'a', 0xD83D, 'b', 0xDC57}, true), 1),
              "a\uFFFDb\uFFFD");
    EXPECT_EQ(decoded(utf16(std::u16string{0xFEFF, 'a', 0xD83D}, true), 3), "a\uFFFD");
}

TEST(Text, WhatCannotBeDecodedIsRefusedWithItsPlace) {
    const auto problem = [](std::string_view bytes) {
        try {
            decode_text(bytes, "a.toml", OddBytes::refuse);
        } catch (const Error &error) {
            return error.problems().at(0);
        }
        return Problem{};
    };
    EXPECT_EQ(problem("# one\r\nname = \"\xBE\"\n").where, "a.toml:2:9");
    EXPECT_EQ(problem("# one\r\nname = \"\xBE\"\n").what, "the byte BE is not UTF-8");
    for (const std::string_view bytes : {"\xFF\xFE\0\0v\0\0\0"sv, "\0\0\xFE\xFFv"sv, "v\0\0\0"sv}) {
        EXPECT_EQ(problem(bytes).what, "the text is UTF-32");
        EXPECT_EQ(problem(bytes).where, "a.toml");
    }
    EXPECT_EQ(decode_text("\xEF\xBB\xBF\xC3\xA9\r\n", "a.toml", OddBytes::refuse), "\xC3\xA9\n");
}

} // namespace
} // namespace tsuya::test

#include "tsuya/sdk/text.h"

#include <algorithm>
#include <utility>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya {
namespace {

constexpr std::size_t kLongestMark = 4; // bytes of a byte order mark

unsigned char byte_at(std::string_view text, std::size_t i) {
    return static_cast<unsigned char>(text[i]);
}

/// Number of bytes at the start that are ASCII without '\r'.
std::size_t plain_run(std::string_view text) {
    constexpr std::size_t kStep = 64; // that the compiler turns into few instructions
    const auto is_plain = [](char c) { return static_cast<signed char>(c) >= 0 && c != '\r'; };
    std::size_t run = 0;
    for (; run + kStep <= text.size(); run += kStep) {
        int odd = 0;
        for (std::size_t i = 0; i < kStep; ++i)
            odd += !is_plain(text[run + i]);
        if (odd > 0)
            break;
    }
    while (run < text.size() && is_plain(text[run]))
        ++run;
    return run;
}

/// Bytes of the well-formed character at the start ([Unicode] Table 3-7), more than there are where
/// its rest is missing; 0 where there is none.
std::size_t character_bytes(std::string_view text) {
    const unsigned char lead = byte_at(text, 0);
    const std::size_t bytes = lead < 0x80                   ? 1
                              : lead >= 0xC2 && lead < 0xE0 ? 2
                              : lead >= 0xE0 && lead < 0xF0 ? 3
                              : lead >= 0xF0 && lead < 0xF5 ? 4
                                                            : 0;
    for (std::size_t i = 1; i < std::min(bytes, text.size()); ++i) {
        const unsigned char low = i > 1 ? 0x80 : lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
        const unsigned char high = i > 1 ? 0xBF : lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
        if (byte_at(text, i) < low || byte_at(text, i) > high)
            return 0;
    }
    return bytes;
}

void append_utf8(char32_t point, std::string &text) {
    const auto tail = [&](int shift) { text += static_cast<char>(0x80 | (point >> shift & 0x3F)); };
    if (point < 0x80) {
        text += static_cast<char>(point);
    } else if (point < 0x800) {
        text += static_cast<char>(0xC0 | point >> 6);
        tail(0);
    } else if (point < 0x10000) {
        text += static_cast<char>(0xE0 | point >> 12);
        tail(6), tail(0);
    } else {
        text += static_cast<char>(0xF0 | point >> 18);
        tail(12), tail(6), tail(0);
    }
}

std::string hexadecimal(unsigned char byte) {
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    return {kDigits[byte >> 4], kDigits[byte & 15]};
}

} // namespace

TextDecoder::TextDecoder(std::string name, OddBytes odd_bytes)
    : name_(std::move(name)), odd_bytes_(odd_bytes) {}

void TextDecoder::decode(std::string_view bytes, std::string &text) {
    waiting_ += bytes;
    decode_waiting(false, text);
}

void TextDecoder::finish(std::string &text) { decode_waiting(true, text); }

void TextDecoder::decode_waiting(bool at_end, std::string &text) {
    if (encoding_ == Encoding::unknown) {
        if (waiting_.size() < kLongestMark && !at_end)
            return;
        find_encoding();
    }
    waiting_.erase(0, encoding_ == Encoding::utf8 ? decode_utf8(at_end, text)
                                                  : decode_utf16(at_end, text));
}

void TextDecoder::find_encoding() {
    using namespace std::string_view_literals;
    const std::string_view text = waiting_;
    const auto null_at = [&](std::size_t i) { return text.size() > i && text[i] == '\0'; };
    if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv) ||
        (null_at(1) && null_at(2) && null_at(3)))
        throw Error({"the text is UTF-32", name_, "expected UTF-8 or UTF-16"});
    std::size_t mark = 0;
    encoding_ = Encoding::utf8;
    if (text.starts_with("\xEF\xBB\xBF")) {
        mark = 3;
    } else if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
        mark = 2;
        encoding_ = byte_at(text, 0) == 0xFF ? Encoding::utf16_little : Encoding::utf16_big;
    } else if (text.size() > 1 && null_at(0) != null_at(1)) {
        encoding_ = null_at(1) ? Encoding::utf16_little : Encoding::utf16_big;
    }
    waiting_.erase(0, mark);
}

std::size_t TextDecoder::decode_utf8(bool at_end, std::string &text) {
    const std::string_view bytes = waiting_;
    std::size_t at = 0;
    while (at < bytes.size()) {
        if (std::exchange(after_return_, false) && bytes[at] == '\n') {
            ++at;
            continue;
        }
        const std::size_t run = plain_run(bytes.substr(at));
        text += bytes.substr(at, run);
        at += run;
        if (at == bytes.size())
            break;
        const std::size_t taken = take_character(bytes.substr(at), at_end, text);
        if (taken == 0)
            break;
        at += taken;
    }
    return at;
}

/// One character that is no plain one; 0 where it waits for more bytes.
std::size_t TextDecoder::take_character(std::string_view rest, bool at_end, std::string &text) {
    if (rest.front() == '\r') {
        after_return_ = true;
        text += '\n';
        return 1;
    }
    const std::size_t bytes = character_bytes(rest);
    if (rest.size() < std::max<std::size_t>(bytes, 2) && !at_end)
        return 0;
    if (bytes > 0 && bytes <= rest.size()) {
        text += rest.substr(0, bytes);
        return bytes;
    }
    // A backslash behind an odd byte is the second byte of a character, as in Shift JIS and Big5.
    const std::size_t odd = rest.size() > 1 && rest[1] == '\\' ? 2 : 1;
    if (odd_bytes_ == OddBytes::refuse)
        refuse(rest.substr(0, 1), text);
    for (std::size_t i = 0; i < odd; ++i)
        text += "\\x" + hexadecimal(byte_at(rest, i));
    return odd;
}

void TextDecoder::refuse(std::string_view odd, std::string_view before) const {
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t start = before.rfind('\n');
    const std::size_t column = before.size() - (start == before.npos ? 0 : start + 1) + 1;
    throw Error({"the byte " + hexadecimal(byte_at(odd, 0)) + " is not UTF-8",
                 name_ + ":" + std::to_string(line) + ":" + std::to_string(column),
                 "expected a file saved as UTF-8"});
}

std::size_t TextDecoder::decode_utf16(bool at_end, std::string &text) {
    constexpr char32_t kReplacement = 0xFFFD;
    const std::string_view bytes = waiting_;
    const std::size_t low = encoding_ == Encoding::utf16_little ? 0 : 1;
    const auto unit = [&](std::size_t at) -> char32_t {
        return byte_at(bytes, at + low) | char32_t{byte_at(bytes, at + 1 - low)} << 8;
    };
    const auto is_second = [](char32_t u) { return u >= 0xDC00 && u < 0xE000; };
    std::size_t at = 0;
    while (at + 2 <= bytes.size()) {
        char32_t point = unit(at);
        std::size_t taken = 2;
        if (point >= 0xD800 && point < 0xDC00) {
            if (at + 4 > bytes.size() && !at_end)
                break;
            if (at + 4 <= bytes.size() && is_second(unit(at + 2))) {
                point = 0x10000 + ((point - 0xD800) << 10) + (unit(at + 2) - 0xDC00);
                taken = 4;
            } else {
                point = kReplacement;
            }
        } else if (is_second(point)) {
            point = kReplacement;
        }
        at += taken;
        const bool of_return = std::exchange(after_return_, point == '\r') && point == '\n';
        if (!of_return)
            append_utf8(point == '\r' ? '\n' : point, text);
    }
    if (at_end && at < bytes.size())
        append_utf8(kReplacement, text);
    return at_end ? bytes.size() : at;
}

std::string decode_text(std::string_view bytes, const std::string &name, OddBytes odd_bytes) {
    TextDecoder decoder(name, odd_bytes);
    std::string text;
    text.reserve(bytes.size());
    decoder.decode(bytes, text);
    decoder.finish(text);
    return text;
}

std::string read_text(const std::filesystem::path &file, OddBytes odd_bytes) {
    return decode_text(read_file(file), file.string(), odd_bytes);
}

} // namespace tsuya

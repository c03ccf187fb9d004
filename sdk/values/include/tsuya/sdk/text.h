#pragma once
/// \file
/// Text of any origin as UTF-8 with '\n' at the ends of lines: what every reader of a text format
/// reads through.

#include <filesystem>
#include <string>
#include <string_view>

namespace tsuya {

/// What becomes of bytes that are not UTF-8, as names in a national code page are.
enum class OddBytes {
    escape, ///< `\xB0`, one for each byte: text that can be shown and compared
    refuse  ///< an Error with line and column, for formats that demand UTF-8
};

/// Decodes a text block by block. A byte order mark is taken off; UTF-16, known by its mark or by a
/// first character below 256, becomes UTF-8; CR LF and a lone CR become LF. A half of a
/// surrogate pair becomes U+FFFD.
class TextDecoder {
  public:
    /// \param name of the file, for errors
    explicit TextDecoder(std::string name, OddBytes odd_bytes = OddBytes::escape);

    /// Appends what the next bytes say to `text`; a character that they begin waits for its rest.
    /// Throws Error naming the file: UTF-32; a byte that is refused, with its line and column, for
    /// which `text` has to hold everything so far.
    void decode(std::string_view bytes, std::string &text);
    /// Appends what still waits, at the end of the text. Throws as `decode`.
    void finish(std::string &text);

  private:
    enum class Encoding { unknown, utf8, utf16_little, utf16_big };

    void decode_waiting(bool at_end, std::string &text);
    void find_encoding();
    std::size_t decode_utf8(bool at_end, std::string &text);
    std::size_t decode_utf16(bool at_end, std::string &text);
    std::size_t take_character(std::string_view rest, bool at_end, std::string &text);
    [[noreturn]] void refuse(std::string_view odd, std::string_view before) const;

    std::string name_;
    OddBytes odd_bytes_;
    Encoding encoding_ = Encoding::unknown;
    bool after_return_ = false; ///< the last character was '\r': '\n' belongs to it
    std::string waiting_{};     ///< bytes that were not decoded yet
};

/// The whole text, as TextDecoder decodes it.
std::string decode_text(std::string_view bytes, const std::string &name,
                        OddBytes odd_bytes = OddBytes::escape);

/// The text of a file. Throws Error as read_file and TextDecoder.
std::string read_text(const std::filesystem::path &file, OddBytes odd_bytes = OddBytes::escape);

} // namespace tsuya

#pragma once
/// \file
/// A place in the text of an OBJ file that knows its line and column.

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>
#include <string_view>

namespace tsuya::garment {

/// Walks over words of one logical line; a backslash before the line end continues it.
class TextCursor {
  public:
    TextCursor(std::string_view text, std::string name)
        : at_(text.data()), end_(text.data() + text.size()), line_start_(at_),
          name_(std::move(name)) {}

    bool at_text_end() const { return at_ == end_; }

    /// Goes on in the text of the lines that follow; lines are counted on.
    void continue_in(std::string_view text) {
        at_ = line_start_ = text.data();
        end_ = at_ + text.size();
    }

    /// Skips blanks and continued line ends; false at the end of the line or at a comment.
    bool skip_blanks() {
        for (; at_ != end_; ++at_) {
            if (*at_ == ' ' || *at_ == '\t' || *at_ == '\r')
                continue;
            if (*at_ != '\\' || !skip_continuation())
                break;
        }
        return at_ != end_ && *at_ != '\n' && *at_ != '#';
    }

    /// Moves to the start of the next logical line.
    void next_line() {
        while (at_ != end_ && *at_ != '\n') {
            if (*at_ == '\\')
                skip_continuation();
            ++at_;
        }
        if (at_ != end_) {
            ++at_;
            start_line();
        }
    }

    /// The characters up to the next blank or line end.
    std::string_view word() {
        const char *begin = at_;
        while (at_ != end_ && !is_blank(*at_))
            ++at_;
        return {begin, static_cast<std::size_t>(at_ - begin)};
    }

    /// The rest of the line without blanks at its ends.
    std::string_view rest() {
        const char *begin = at_;
        while (at_ != end_ && *at_ != '\n')
            ++at_;
        const char *last = at_;
        while (last != begin && is_blank(last[-1]))
            --last;
        return {begin, static_cast<std::size_t>(last - begin)};
    }

    /// A finite number that is a word of its own; false leaves the cursor where it was.
    bool number(double &value) {
        const char *begin = at_ != end_ && *at_ == '+' ? at_ + 1 : at_;
        const auto [stop, error] = std::from_chars(begin, end_, value);
        if (error == std::errc::result_out_of_range) // too small becomes 0, too large infinity
            value = std::strtod(std::string(begin, stop).c_str(), nullptr);
        else if (error != std::errc{})
            return false;
        if (!std::isfinite(value) || (stop != end_ && !is_blank(*stop)))
            return false;
        at_ = stop;
        return true;
    }

    /// An index; false leaves the cursor where it was.
    bool index(long long &value) {
        const auto [stop, error] = std::from_chars(at_, end_, value);
        if (error != std::errc{})
            return false;
        at_ = stop;
        return true;
    }

    /// Steps over `c`; false if it is not there.
    bool take(char c) {
        if (at_ == end_ || *at_ != c)
            return false;
        ++at_;
        return true;
    }

    bool at_blank() const { return at_ == end_ || is_blank(*at_); }
    const char *position() const { return at_; }
    std::uint32_t line() const { return line_; }
    std::uint32_t column(const char *place) const {
        return static_cast<std::uint32_t>(place - line_start_) + 1;
    }
    /// `file:line:column`
    std::string where(std::uint32_t line, std::uint32_t column) const {
        return name_ + ":" + std::to_string(line) + ":" + std::to_string(column);
    }
    std::string where() const { return where(line_, column(at_)); }

  private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

    void start_line() {
        ++line_;
        line_start_ = at_;
    }

    /// At a backslash: if a line end follows, moves onto its last character.
    bool skip_continuation() {
        const char *p = at_ + 1;
        if (p != end_ && *p == '\r')
            ++p;
        if (p == end_ || *p != '\n')
            return false;
        at_ = p + 1;
        start_line();
        --at_;
        return true;
    }

    const char *at_, *end_, *line_start_;
    std::uint32_t line_ = 1;
    std::string name_;
};

} // namespace tsuya::garment

#include "project/comments.h"

#include "project/repository.h"

#include <algorithm>
#include <cctype>

namespace tsuya::project {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Walks a C++ text once, copying each character to the half that it belongs to.
class Splitter {
  public:
    explicit Splitter(std::string_view text) : text_(text) {}

    SplitSource run() {
        while (at_ < text_.size())
            step();
        return std::move(split_);
    }

  private:
    bool next_is(std::string_view word) const { return text_.substr(at_).starts_with(word); }

    void step() {
        if (next_is("//"))
            take_comment(text_.find('\n', at_), 2);
        else if (next_is("/*"))
            take_comment(end_after("*/", at_ + 2), 2);
        else if (next_is("R\"") && (at_ == 0 || !is_word(text_[at_ - 1])))
            take_literal(raw_string_end());
        else if (text_[at_] == '"' && !on_include_line())
            take_literal(quoted_end('"'));
        else if (text_[at_] == '\'' && (at_ == 0 || !is_word(text_[at_ - 1])))
            take_literal(quoted_end('\''));
        else
            put(text_[at_++], ' ');
    }

    /// A newline goes to both halves, so that lines can be counted in either.
    void put(char code, char comment) {
        split_.code += text_[at_ - 1] == '\n' ? '\n' : code;
        split_.comments += text_[at_ - 1] == '\n' ? '\n' : comment;
    }

    void take_comment(std::size_t end, std::size_t mark) {
        end = std::min(end, text_.size());
        for (const std::size_t begin = at_; at_ < end;) {
            const char c = text_[at_++];
            put(' ', at_ - begin <= mark ? ' ' : c);
        }
    }

    void take_literal(std::size_t end) {
        const char quote = text_[at_];
        for (end = std::min(end, text_.size()); at_ < end;) {
            ++at_;
            put(' ', ' ');
        }
        split_.code.back() = quote;
    }

    std::size_t end_after(std::string_view mark, std::size_t from) const {
        const std::size_t found = text_.find(mark, from);
        return found == std::string_view::npos ? text_.size() : found + mark.size();
    }

    std::size_t raw_string_end() const {
        const std::size_t open = std::min(text_.find('(', at_), text_.size());
        const std::string close = ")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + "\"";
        return end_after(close, open);
    }

    std::size_t quoted_end(char quote) const {
        std::size_t i = at_ + 1;
        while (i < text_.size() && text_[i] != quote && text_[i] != '\n')
            i += text_[i] == '\\' ? 2 : 1;
        return i < text_.size() && text_[i] == '\n' ? i : i + 1;
    }

    bool on_include_line() const {
        const std::size_t begin = split_.code.rfind('\n');
        const std::string line = split_.code.substr(begin == std::string::npos ? 0 : begin + 1);
        const std::size_t hash = line.find_first_not_of(" \t");
        return hash != std::string::npos && line[hash] == '#' &&
               line.find("include", hash) != std::string::npos;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    SplitSource split_;
};

} // namespace

SplitSource split_cpp(std::string_view text) { return Splitter(text).run(); }

std::string hash_comments(std::string_view text) {
    std::string comments;
    for (const std::string &line : lines_of(text)) {
        for (std::size_t i = 0; i < line.size(); ++i)
            if (line[i] == '#' && (i == 0 || line[i - 1] == ' ' || line[i - 1] == '\t')) {
                comments += line.substr(i + 1);
                break;
            }
        comments += '\n';
    }
    return comments;
}

std::string markdown_prose(std::string_view text) {
    std::string prose;
    bool in_fence = false;
    bool in_comment = false;
    for (const std::string &line : lines_of(text)) {
        const std::size_t first = line.find_first_not_of(' ');
        const bool fence =
            first != std::string::npos && line.compare(first, 3, "```") == 0 && !in_comment;
        if (fence)
            in_fence = !in_fence;
        bool in_span = false;
        for (std::size_t i = 0; i < line.size() && !fence && !in_fence; ++i) {
            if (line.compare(i, 4, "<!--") == 0)
                in_comment = true;
            if (line[i] == '`')
                in_span = !in_span;
            else if (!in_span && !in_comment)
                prose += line[i];
            if (i >= 2 && line.compare(i - 2, 3, "-->") == 0)
                in_comment = false;
        }
        prose += '\n';
    }
    return prose;
}

} // namespace tsuya::project

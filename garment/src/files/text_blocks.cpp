#include "files/text_blocks.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

constexpr std::size_t kBlockBytes = std::size_t{1} << 20;

/// Bytes of `text` up to the end of its last line that is not continued; 0 if there is none.
std::size_t whole_lines(std::string_view text) {
    for (std::size_t end = text.rfind('\n'); end != text.npos; end = text.rfind('\n', end - 1)) {
        const std::size_t last = end > 0 && text[end - 1] == '\r' ? end - 1 : end;
        if (last == 0 || text[last - 1] != '\\')
            return end + 1;
    }
    return 0;
}

} // namespace

TextBlocks::TextBlocks(const std::filesystem::path &file) : name_(file.string()) {
    std::error_code code;
    if (std::filesystem::is_directory(file, code))
        throw Error({"it is a folder", name_, "expected a file"});
    in_.open(file, std::ios::binary);
    if (!in_)
        throw Error({std::string("the file cannot be opened: ") + std::strerror(errno), name_, ""});
}

void TextBlocks::read_more() {
    // Twice as much where one line is longer than what there is, so that it is searched few times.
    buffer_.resize(filled_ + std::max(filled_, kBlockBytes));
    in_.read(buffer_.data() + filled_, static_cast<std::streamsize>(buffer_.size() - filled_));
    if (in_.bad())
        throw Error({"the file cannot be read", name_, ""});
    filled_ += static_cast<std::size_t>(in_.gcount());
}

std::string_view TextBlocks::next() {
    // What was read beyond the last block comes first.
    buffer_.erase(0, given_);
    filled_ -= given_;
    std::size_t end = 0;
    while (end == 0 && in_) {
        read_more();
        end = in_ ? whole_lines({buffer_.data(), filled_}) : filled_;
    }
    given_ = end;
    return {buffer_.data(), given_};
}

} // namespace tsuya::garment

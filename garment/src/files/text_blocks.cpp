#include "files/text_blocks.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "files/block_bytes.h"
#include "tsuya/sdk/error.h"

namespace tsuya::garment {
namespace {

/// Bytes of `text` up to the end of its last line that is not continued; 0 if there is none.
std::size_t whole_lines(std::string_view text) {
    for (std::size_t end = text.rfind('\n'); end != text.npos; end = text.rfind('\n', end - 1))
        if (end == 0 || text[end - 1] != '\\')
            return end + 1;
    return 0;
}

} // namespace

TextBlocks::TextBlocks(const std::filesystem::path &file) : name_(file.string()), decoder_(name_) {
    std::error_code code;
    if (std::filesystem::is_directory(file, code))
        throw Error({"it is a folder", name_, "expected a file"});
    in_.open(file, std::ios::binary);
    if (!in_)
        throw Error({std::string("the file cannot be opened: ") + std::strerror(errno), name_,
                     "expected a file that may be read"});
}

void TextBlocks::read_more() {
    // Twice as much where one line is longer than what there is, so that it is searched few times.
    bytes_.resize(std::max(buffer_.size(), kBlockBytes));
    in_.read(bytes_.data(), static_cast<std::streamsize>(bytes_.size()));
    if (in_.bad())
        throw Error({"the file cannot be read", name_, ""});
    decoder_.decode({bytes_.data(), static_cast<std::size_t>(in_.gcount())}, buffer_);
    if (!in_)
        decoder_.finish(buffer_);
}

std::string_view TextBlocks::next() {
    // What was read beyond the last block comes first.
    buffer_.erase(0, given_);
    std::size_t end = 0;
    while (end == 0 && in_) {
        read_more();
        end = in_ ? whole_lines(buffer_) : buffer_.size();
    }
    given_ = end;
    return std::string_view(buffer_).substr(0, given_);
}

} // namespace tsuya::garment

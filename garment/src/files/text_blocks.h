#pragma once
/// \file
/// A text file decoded block by block, so that its size does not count.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "tsuya/sdk/text.h"

namespace tsuya::garment {

/// Blocks of whole logical lines: none ends within a line, nor where a backslash continues one.
class TextBlocks {
  public:
    /// Throws Error naming the file if it cannot be opened.
    explicit TextBlocks(const std::filesystem::path &file);

    /// The next block, valid until the next call; empty at the end of the file. Longer than usual
    /// where one line is. Throws Error naming the file if it cannot be read
    /// or decoded.
    std::string_view next();

  private:
    void read_more();

    std::ifstream in_;
    std::string name_, bytes_, buffer_;
    TextDecoder decoder_;
    std::size_t given_ = 0; ///< bytes of `buffer_` that were returned
};

} // namespace tsuya::garment

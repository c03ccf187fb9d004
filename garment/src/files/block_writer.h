#pragma once
/// \file
/// A file that is written block by block, by atomic replacement.

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>

#include "files/block_bytes.h"
#include "mesh/stop.h"
#include "tsuya/sdk/file.h"

namespace tsuya::garment {

/// A name in a format whose names end with their line: line ends in it become blanks.
inline std::string one_line(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return name;
}

/// Collects bytes and writes them in blocks, with a look at the stop flag at each: a file may be
/// larger than the memory that is left. Without `commit` nothing stands under the name.
class BlockWriter {
  public:
    /// \param progress must outlive this
    BlockWriter(std::filesystem::path file, const Progress &progress)
        : file_(std::move(file)), progress_(progress) {}

    /// What was collected; to be appended to.
    std::string &bytes() { return bytes_; }
    /// Called after each line or entry. Throws Error as FileReplacement, and Interrupted.
    void end_entry() {
        if (bytes_.size() >= kBlockBytes)
            write_block();
    }
    void commit() {
        write_block();
        file_.commit();
    }

  private:
    void write_block() {
        look_at_stop(progress_);
        file_.write(bytes_);
        bytes_.clear();
    }

    FileReplacement file_;
    const Progress &progress_;
    std::string bytes_;
};

} // namespace tsuya::garment

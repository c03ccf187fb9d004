#pragma once
/// \file
/// The file in which long work keeps what it has, so that it can go on later.

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "tsuya/sdk/file.h"

namespace tsuya::detail {

/// Writes a checkpoint beside an older one and replaces it by `commit`. Numbers are kept as they
/// lie in memory: a checkpoint is for the machine that wrote it.
class CheckpointWriter {
  public:
    /// \param kind what was at work, such as "render 2": name and version of the layout
    /// \param fingerprint of all that the numbers depend on
    /// Throws Error naming the file where it cannot be written.
    CheckpointWriter(const std::filesystem::path &file, std::string_view kind,
                     std::uint64_t fingerprint);
    template <class T> void value(const T &v) { array(std::span(&v, 1)); }
    template <class T> void array(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        file_.write({reinterpret_cast<const char *>(values.data()), values.size_bytes()});
    }
    /// Throws Error naming the file; the older checkpoint stays then.
    void commit() { file_.commit(); }

  private:
    FileReplacement file_;
};

/// Reads what CheckpointWriter wrote, in the same order.
class CheckpointReader {
  public:
    /// Throws Error naming the file: it cannot be read, is no checkpoint of this kind, or has
    /// another fingerprint.
    CheckpointReader(const std::filesystem::path &file, std::string_view kind,
                     std::uint64_t fingerprint);
    template <class T> void value(T &v) { array(std::span(&v, 1)); }
    /// Throws Error naming the file where it is cut off.
    template <class T> void array(std::span<T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        read(reinterpret_cast<char *>(values.data()), values.size_bytes());
    }
    /// Throws Error naming the file if there is more in it.
    void finish();

  private:
    void read(char *to, std::size_t size);

    std::filesystem::path path_;
    std::ifstream in_;
};

} // namespace tsuya::detail

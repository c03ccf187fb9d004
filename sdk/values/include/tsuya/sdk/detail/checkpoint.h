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

#include "tsuya/sdk/detail/hasher.h"
#include "tsuya/sdk/file.h"

namespace tsuya::detail {

/// What the numbers of a checkpoint depend on, as hashes: two, so that a message can say which
/// of them is another.
struct Fingerprint {
    std::uint64_t input = 0;    ///< what is worked on
    std::uint64_t settings = 0; ///< how
    bool operator==(const Fingerprint &) const = default;
};

/// Writes a checkpoint beside an older one and replaces it by `commit`. Numbers are kept as they
/// lie in memory: a checkpoint is for the machine that wrote it. The file: a line with its kind,
/// the fingerprint and a checksum of the two; the numbers and their checksum.
class CheckpointWriter {
  public:
    /// \param kind what was at work, such as "render 3": name and version of the layout
    /// Throws Error naming the file where it cannot be written.
    CheckpointWriter(const std::filesystem::path &file, std::string_view kind,
                     const Fingerprint &fingerprint);
    template <class T> void value(const T &v) { array(std::span(&v, 1)); }
    template <class T> void array(std::span<const T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        write(reinterpret_cast<const char *>(values.data()), values.size_bytes());
    }
    /// Throws Error naming the file; the older checkpoint stays then.
    void commit();

  private:
    void write(const char *from, std::size_t size);
    void write_checksum();

    FileReplacement file_;
    Hasher hasher_{};
};

/// Reads what CheckpointWriter wrote, in the same order.
class CheckpointReader {
  public:
    /// Throws Error naming the file: it cannot be read, is no checkpoint of this kind, is damaged,
    /// or is of other input or other settings.
    CheckpointReader(const std::filesystem::path &file, std::string_view kind,
                     const Fingerprint &fingerprint);
    template <class T> void value(T &v) { array(std::span(&v, 1)); }
    /// Throws Error naming the file where it is cut off.
    template <class T> void array(std::span<T> values) {
        static_assert(std::is_trivially_copyable_v<T>);
        read(reinterpret_cast<char *>(values.data()), values.size_bytes());
    }
    /// Throws Error naming the file where the numbers are not those that were written, or there is
    /// more in it. Only then are they to be used.
    void finish();

  private:
    void read(char *to, std::size_t size);
    void check_checksum(const char *of);
    [[noreturn]] void refuse_damage(const std::string &what) const;

    std::filesystem::path path_;
    std::ifstream in_;
    Hasher hasher_{};
};

} // namespace tsuya::detail

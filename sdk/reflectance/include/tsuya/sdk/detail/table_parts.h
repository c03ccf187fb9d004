#pragma once
/// \file
/// The members of tables as lists that are written once and visited, and the bytes of a file that
/// keeps them.
///
/// For a class T of tables, `each_part(f, t)` calls `f` with every member that is to be kept. It
/// takes the class apart with a structured binding, so that a member that is added and not listed
/// does not compile.

#include <array>
#include <concepts>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "tsuya/sdk/detail/fields.h"

namespace tsuya::detail {

/// Bytes as they lie in memory: for the build that wrote them.
class TableWriter {
  public:
    /// Members as `each_part` lists them.
    template <class... Parts> void operator()(const Parts &...parts) { (add(parts), ...); }
    const std::string &bytes() const { return bytes_; } ///< of all so far

  private:
    template <class T> void add(const T &part) {
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char *>(&part), sizeof part);
        else
            each_part(*this, part);
    }
    template <class T> void add(const std::vector<T> &parts) {
        add(parts.size());
        if constexpr (std::is_trivially_copyable_v<T>)
            bytes_.append(reinterpret_cast<const char *>(parts.data()), parts.size() * sizeof(T));
        else
            for (const T &part : parts)
                add(part);
    }
    template <class T, std::size_t N>
    requires(!std::is_trivially_copyable_v<T>) void add(const std::array<T, N> &parts) {
        for (const T &part : parts)
            add(part);
    }

    std::string bytes_{};
};

/// Reads what TableWriter wrote, in the same order.
class TableReader {
  public:
    /// \param bytes that outlive the reader, and whose checksum is right
    explicit TableReader(std::string_view bytes) : bytes_(bytes) {}
    /// Throws Error where they end too soon.
    template <class... Parts> void operator()(Parts &...parts) { (read(parts), ...); }
    /// All was read.
    bool at_end() const { return bytes_.empty(); }

  private:
    /// The next bytes.
    const char *take(std::size_t count, std::size_t size);

    template <class T> void read(T &part) {
        if constexpr (std::is_trivially_copyable_v<T>)
            std::memcpy(static_cast<void *>(&part), take(1, sizeof part), sizeof part);
        else
            each_part(*this, part);
    }
    template <class T> void read(std::vector<T> &parts) {
        std::size_t count = 0;
        read(count);
        if constexpr (std::is_trivially_copyable_v<T>) {
            const char *const from = take(count, sizeof(T));
            parts.resize(count);
            if (count > 0)
                std::memcpy(static_cast<void *>(parts.data()), from, count * sizeof(T));
        } else {
            need(count);
            parts.resize(count);
            for (T &part : parts)
                read(part);
        }
    }
    template <class T, std::size_t N>
    requires(!std::is_trivially_copyable_v<T>) void read(std::array<T, N> &parts) {
        for (T &part : parts)
            read(part);
    }
    /// Throws Error where there are fewer bytes left than this.
    void need(std::size_t count) const;

    std::string_view bytes_;
};

} // namespace tsuya::detail

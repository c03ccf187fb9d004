#pragma once
/// \file
/// A hash of values, the same on every run: for telling whether a checkpoint fits.

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

#include <glm/glm.hpp>

namespace tsuya::detail {

/// FNV-1a over the bytes of what it is given, in that order [FNV].
class Hasher {
  public:
    /// A number or an enumerator. Structs may have bytes between their fields: hash field by field.
    template <class T>
    requires(std::is_arithmetic_v<T> || std::is_enum_v<T>) void value(const T &v) {
        bytes(&v, sizeof v);
    }
    template <glm::length_t N, class T, glm::qualifier Q> void value(const glm::vec<N, T, Q> &v) {
        static_assert(sizeof v == N * sizeof(T));
        bytes(&v, sizeof v);
    }
    /// With its length, so that neighbours cannot run into each other.
    void text(std::string_view text) {
        value(text.size());
        bytes(text.data(), text.size());
    }
    /// Numbers or vectors, with their count.
    template <class T> void array(std::span<const T> values) {
        value(values.size());
        for (const T &v : values)
            value(v);
    }
    /// Bytes as they lie in memory, without their count.
    void bytes(const void *data, std::size_t size) {
        const auto *byte = static_cast<const unsigned char *>(data);
        for (std::size_t i = 0; i < size; ++i)
            state_ = (state_ ^ byte[i]) * 1099511628211ull;
    }
    std::uint64_t result() const { return state_; }

  private:
    std::uint64_t state_ = 14695981039346656037ull;
};

} // namespace tsuya::detail

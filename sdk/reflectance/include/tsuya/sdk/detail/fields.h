#pragma once
/// \file
/// The fields of a struct as a list that is written once and visited: by the readers and writers of
/// files, and by fingerprints.
///
/// For a struct S, `each_field(f, s)` calls `f(Field, member)` for every member, for a const S with
/// const members. It takes the struct apart with a structured binding, so that a member that is
/// added and not listed does not compile.

#include <array>
#include <concepts>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/detail/hasher.h"

namespace tsuya::detail {

/// A member as files and messages name it.
struct Field {
    std::string_view key;
    /// Accepted range of numbers
    double low = -std::numeric_limits<double>::max(), high = std::numeric_limits<double>::max();
    bool required = false;  ///< in a file
    bool written = true;    ///< false: at its value it says nothing, and is left out of a file
    bool in_picture = true; ///< false: a render may go on though it has changed
};

/// S or const S.
template <class T, class S>
concept MaybeConst = std::same_as<std::remove_const_t<T>, S>;

/// Hashes what decides the picture: every field but those that are not `in_picture`, with the
/// presence of optional ones, the kind of variants and the length of arrays.
class FieldHasher {
  public:
    template <class T> void operator()(const Field &field, const T &value) {
        if (field.in_picture)
            add(value);
    }
    template <class T> void add(const T &value) {
        if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
            hasher_.value(value);
        else
            each_field(*this, value);
    }
    template <glm::length_t N, class T, glm::qualifier Q> void add(const glm::vec<N, T, Q> &value) {
        hasher_.value(value);
    }
    void add(const std::string &text) { hasher_.text(text); }
    void add(const std::filesystem::path &path) { hasher_.text(path.string()); }
    void add(const std::monostate &) {}
    template <class T> void add(const std::optional<T> &value) {
        hasher_.value(value.has_value());
        if (value)
            add(*value);
    }
    template <class... Kinds> void add(const std::variant<Kinds...> &value) {
        hasher_.value(value.index());
        std::visit([&](const auto &kind) { add(kind); }, value);
    }
    template <class T> void add(const std::vector<T> &values) {
        hasher_.value(values.size());
        for (const T &value : values)
            add(value);
    }
    template <class Key, class T> void add(const std::map<Key, T> &values) {
        hasher_.value(values.size());
        for (const auto &[key, value] : values) {
            add(key);
            add(value);
        }
    }
    template <class T, std::size_t N> void add(const std::array<T, N> &values) {
        for (const T &value : values)
            add(value);
    }
    std::uint64_t result() const { return hasher_.result(); }

  private:
    Hasher hasher_{};
};

} // namespace tsuya::detail

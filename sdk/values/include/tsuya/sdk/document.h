#pragma once
/// \file
/// A TOML file: every value is read by name, every problem has its line and column, and a key that
/// nobody reads is an unknown key.

#include <concepts>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/error.h"

namespace tsuya {

namespace detail {
struct DocumentState;
}

/// A table of the document. Getters note a problem and return a usable value where the key is
/// missing or wrong; `Document::finish` throws them all.
class Section {
  public:
    /// The key is there, with any value.
    bool has(std::string_view key) const;
    /// The key is there, and its value is a text.
    bool is_text(std::string_view key) const;
    /// file:line:column of a key, of the section where the key is absent.
    std::string where(std::string_view key = {}) const;

    /// A text; empty where the key is absent.
    std::optional<std::string> text(std::string_view key) const;
    /// A text; a problem where the key is absent.
    std::string required_text(std::string_view key) const;
    /// Numbers outside [low, high] and not finite ones are problems.
    std::optional<double> number(std::string_view key,
                                 double low = -std::numeric_limits<double>::max(),
                                 double high = std::numeric_limits<double>::max()) const;
    /// As `number`; a problem where the key is absent.
    double required_number(std::string_view key, double low = -std::numeric_limits<double>::max(),
                           double high = std::numeric_limits<double>::max()) const;
    /// A whole number; outside [low, high] it is a problem.
    template <std::integral T> std::optional<T> integer(std::string_view key, T low, T high) const {
        const std::optional<std::int64_t> value = whole_number(key, low, high);
        return value ? std::optional(static_cast<T>(*value)) : std::nullopt;
    }
    /// true or false.
    std::optional<bool> flag(std::string_view key) const;
    /// An array of finite numbers.
    std::optional<std::vector<double>> numbers(std::string_view key) const;
    /// An array of three finite numbers.
    std::optional<glm::dvec3> vector(std::string_view key) const;
    /// An array of texts.
    std::optional<std::vector<std::string>> texts(std::string_view key) const;
    /// All keys of the section with texts as values.
    std::vector<std::pair<std::string, std::string>> all_texts() const;

    /// A table in the table; empty where absent.
    std::optional<Section> section(std::string_view key) const;
    /// All tables in the table, in the order of the file: `[fabrics.satin]`, `[fabrics.lining]`.
    std::vector<std::pair<std::string, Section>> sections() const;

    /// The tables of an array, such as `[[camera.path]]`, in their order; none where absent.
    std::vector<Section> list(std::string_view key) const;

    /// Keys of the section that nobody reads are no unknown keys: what would tell them is wrong.
    void leave_unjudged() const;

    /// Notes a problem at a key.
    void problem(std::string_view key, std::string what, std::string accepted) const;
    /// Notes the problems of an error at a key. One that is at a file, or at a place in one, keeps
    /// that in front of what is wrong.
    void problem(std::string_view key, const Error &error) const;

  private:
    friend class Document;
    std::optional<std::int64_t> whole_number(std::string_view key, std::int64_t low,
                                             std::int64_t high) const;

    Section(detail::DocumentState *state, const void *table, std::string name)
        : state_(state), table_(table), name_(std::move(name)) {}
    /// The name that a table at the key has in the file: `camera.path`.
    std::string full_name(std::string_view key) const;

    detail::DocumentState *state_;
    const void *table_;
    std::string name_; ///< of the table in the file; empty for the root
};

/// A TOML file that is read key by key.
class Document {
  public:
    /// Throws Error with file:line:column if the file cannot be read or is not TOML.
    explicit Document(const std::filesystem::path &file);
    ~Document();
    Document(const Document &) = delete;
    Document &operator=(const Document &) = delete;

    /// The keys before the first table, and all tables.
    Section root() const;
    /// Throws Error with every problem noted so far, unknown keys among them with the nearest known
    /// key.
    void finish() const;

  private:
    std::unique_ptr<detail::DocumentState> state_;
};

} // namespace tsuya

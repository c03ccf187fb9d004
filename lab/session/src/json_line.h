#pragma once
/// \file
/// One line of JSON whose members are taken one after the other.

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tsuya/sdk/error.h"

namespace tsuya::lab {

using JsonTree = nlohmann::ordered_json;

/// The lines of a text, without their ends. A last one that has no end is `rest`.
struct TextLines {
    std::vector<std::string_view> whole{};
    std::string_view rest{};
};
TextLines lines_of(std::string_view text);

/// Members that are missing or no such value throw Error with `where`, as does what is left over at
/// finish().
class JsonLine {
  public:
    JsonLine(std::string_view line, std::string where);

    bool has(const char *key) const { return tree_.contains(key); }
    std::string text(const char *key);
    double number(const char *key, double low, double high);
    /// A whole number, not negative.
    std::size_t count(const char *key);
    /// The index of a text in the names.
    std::size_t choice(const char *key, const std::vector<std::string> &names);
    const JsonTree &rest() const { return tree_; }
    void finish() const;
    [[noreturn]] void fail(std::string what, std::string accepted = "") const;

  private:
    JsonTree take(const char *key);

    JsonTree tree_;
    std::string where_;
};

} // namespace tsuya::lab

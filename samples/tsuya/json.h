#pragma once
/// \file
/// A JSON value to be written. Its members are in the order of their making.

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tsuya::program {

/// Written as nlohmann-json writes it, whose header takes seconds to compile: only json.cpp has it.
///
///     Json report{{"schema", "tsuya-list 1"}, {"entries", Json::array()}};
///     report["entries"].push_back({{"name", "D65"}});
///     std::cout << report.text() << "\n";
class Json {
  public:
    struct Member;

    Json(); ///< null
    Json(std::same_as<bool> auto value) : value_(value) {}
    Json(std::signed_integral auto value) : value_(static_cast<std::int64_t>(value)) {}
    Json(std::unsigned_integral auto value) requires(!std::same_as<decltype(value), bool>)
        : value_(static_cast<std::uint64_t>(value)) {}
    Json(double value); ///< null where it is not finite
    Json(const char *value);
    Json(std::string value);
    Json(std::string_view value);
    /// An object
    Json(std::initializer_list<Member> members);

    static Json object();
    static Json array(std::initializer_list<Json> values = {});

    /// The member of an object; made where it is missing.
    Json &operator[](std::string_view key);
    /// Appends to an array.
    void push_back(Json value);
    /// Takes over the members of another object.
    void update(const Json &other);

    /// Lines with two spaces a level
    std::string text() const;
    std::string one_line() const;

  private:
    friend struct JsonWriter;
    using Members = std::vector<Member>;
    std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string,
                 std::vector<Json>, Members>
        value_{};
};

/// A key with its value
struct Json::Member {
    std::string key;
    Json value;
};

inline Json::Json() = default;
inline Json::Json(double value) : value_(value) {}
inline Json::Json(const char *value) : value_(std::string(value)) {}
inline Json::Json(std::string value) : value_(std::move(value)) {}
inline Json::Json(std::string_view value) : value_(std::string(value)) {}

} // namespace tsuya::program

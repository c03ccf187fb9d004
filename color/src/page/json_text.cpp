#include "page/json_text.h"

#include <array>
#include <charconv>

namespace tsuya::json {

std::string text(std::string_view value) {
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string quoted = "\"";
    for (const char c : value) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || c == '<' || c == '"' || c == '\\')
            quoted.append("\\u00").append({kHex[byte >> 4], kHex[byte & 15]});
        else
            quoted += c;
    }
    return quoted + '"';
}

std::string number(double value, int digits) {
    std::array<char, 40> buffer{};
    const std::to_chars_result end = std::to_chars(buffer.data(), buffer.data() + buffer.size(),
                                                   value, std::chars_format::general, digits);
    return {buffer.data(), end.ptr};
}

std::string array(std::span<const std::string> items) {
    std::string all = "[";
    for (const std::string &item : items)
        all.append(all.size() > 1 ? "," : "").append(item);
    return all + ']';
}

std::string numbers(std::span<const double> values, int digits) {
    std::string all = "[";
    for (const double value : values)
        all.append(all.size() > 1 ? "," : "").append(number(value, digits));
    return all + ']';
}

std::string vector(const glm::dvec3 &v) { return numbers(std::array{v.x, v.y, v.z}); }

std::string rows(const glm::dmat3 &m) {
    std::array<std::string, 3> all;
    for (int row = 0; row < 3; ++row)
        all[static_cast<std::size_t>(row)] = vector({m[0][row], m[1][row], m[2][row]});
    return array(all);
}

std::string object(std::span<const std::pair<std::string, std::string>> members) {
    std::string all = "{";
    for (const auto &[name, value] : members)
        all.append(all.size() > 1 ? "," : "").append(text(name)).append(":").append(value);
    return all + '}';
}

} // namespace tsuya::json

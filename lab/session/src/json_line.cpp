#include "json_line.h"

#include <algorithm>

namespace tsuya::lab {

TextLines lines_of(std::string_view text) {
    TextLines lines;
    std::size_t at = 0;
    for (std::size_t end; (end = text.find('\n', at)) != std::string_view::npos; at = end + 1)
        lines.whole.push_back(text.substr(at, end - at));
    lines.rest = text.substr(at);
    return lines;
}

JsonLine::JsonLine(std::string_view line, std::string where)
    : tree_(JsonTree::parse(line, nullptr, false)), where_(std::move(where)) {
    if (!tree_.is_object())
        fail("the line is no JSON object", "expected {\"key\": value, ...}");
}

void JsonLine::fail(std::string what, std::string accepted) const {
    throw Error({std::move(what), where_, std::move(accepted)});
}

JsonTree JsonLine::take(const char *key) {
    if (!has(key))
        fail("there is no '" + std::string(key) + "'");
    JsonTree value = tree_[key];
    tree_.erase(key);
    return value;
}

std::string JsonLine::text(const char *key) {
    const JsonTree value = take(key);
    if (!value.is_string())
        fail("'" + std::string(key) + "' is no text");
    return value.get<std::string>();
}

double JsonLine::number(const char *key, double low, double high) {
    const JsonTree value = take(key);
    const double number = value.is_number() ? value.get<double>() : low - 1;
    if (!(number >= low && number <= high))
        fail("'" + std::string(key) + "' is " + value.dump(),
             "expected a number from " + JsonTree(low).dump() + " to " + JsonTree(high).dump());
    return number;
}

std::size_t JsonLine::count(const char *key) {
    const JsonTree value = take(key);
    if (!value.is_number_unsigned())
        fail("'" + std::string(key) + "' is " + value.dump(), "expected a whole number from 0");
    return value.get<std::size_t>();
}

std::size_t JsonLine::choice(const char *key, const std::vector<std::string> &names) {
    const std::string name = text(key);
    const auto at = std::find(names.begin(), names.end(), name);
    if (at == names.end())
        fail("unknown " + std::string(key) + " '" + name + "'", accepted_names(name, names));
    return static_cast<std::size_t>(at - names.begin());
}

void JsonLine::finish() const {
    if (!tree_.empty())
        fail("unknown key '" + tree_.begin().key() + "'");
}

} // namespace tsuya::lab

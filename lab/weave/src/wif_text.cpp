#include "wif_text.h"

#include <algorithm>
#include <charconv>

namespace tsuya::lab::detail {
namespace {

constexpr std::string_view kBlank = " \t\r\f\v";

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

template <class T> bool parse(std::string_view text, T &value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size();
}

int column_of(std::string_view line, std::string_view part) {
    return part.empty() ? static_cast<int>(line.size()) + 1
                        : static_cast<int>(part.data() - line.data()) + 1;
}

/// Digits as a person writes them: 0.1 and not 0.100000.
std::string plain(double value) {
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

std::string range_text(double low, double high) { return plain(low) + " to " + plain(high); }

} // namespace

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char &c : result)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return result;
}

const WifEntry *WifSection::find(std::string_view key) const {
    const auto found = std::find_if(entries.begin(), entries.end(),
                                    [&](const WifEntry &entry) { return entry.key == key; });
    return found == entries.end() ? nullptr : &*found;
}

WifText::WifText(std::string_view text, std::string name) : name_(std::move(name)) {
    WifSection *section = nullptr;
    int number = 0;
    while (!text.empty() && !problems_.full()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        ++number;
        const std::string_view content = trim(line);
        if (content.empty() || content.front() == ';')
            continue;
        if (content.front() == '[') {
            if (content.back() != ']') {
                problem(number, column_of(line, content), "a section without its closing bracket",
                        "expected [SECTION]");
                section = nullptr;
                continue;
            }
            section = &sections_[lower_case(trim(content.substr(1, content.size() - 2)))];
            section->line = number;
            continue;
        }
        const std::size_t equals = content.find('=');
        if (equals == std::string_view::npos || section == nullptr) {
            problem(number, column_of(line, content),
                    section == nullptr ? "an entry outside all sections" : "a line without `=`",
                    "expected key=value in a [SECTION]");
            continue;
        }
        const std::string_view key = trim(content.substr(0, equals));
        const std::string_view value = trim(content.substr(equals + 1));
        section->entries.push_back({lower_case(key), std::string(value), number,
                                    column_of(line, content), column_of(line, value)});
    }
}

const WifSection *WifText::find(std::string_view section) const {
    const auto found = sections_.find(section);
    return found == sections_.end() ? nullptr : &found->second;
}

const WifSection *WifText::require(std::string_view section) {
    const WifSection *found = find(section);
    if (found == nullptr)
        problem(1, 1, "section [" + std::string(section) + "] is missing",
                "expected a Weaving Information File 1.1");
    return found;
}

void WifText::problem(int line, int column, std::string what, std::string accepted) {
    problems_.add({std::move(what),
                   name_ + ":" + std::to_string(line) + ":" + std::to_string(column),
                   std::move(accepted)});
}

void WifText::value_problem(const WifEntry &entry, std::string what, std::string accepted) {
    problem(entry.line, entry.value_column, std::move(what), std::move(accepted));
}

void WifText::finish() const { problems_.throw_if_any(); }

int WifText::integer(const WifEntry &entry, int low, int high) {
    int value = 0;
    if (parse(entry.value, value) && value >= low && value <= high)
        return value;
    value_problem(entry, entry.key + " is \"" + entry.value + "\"",
                  "expected a whole number from " + range_text(low, high));
    return low;
}

std::vector<int> WifText::integers(const WifEntry &entry, int low, int high) {
    std::vector<int> result;
    std::string_view rest = entry.value;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(','), rest.size());
        const std::string_view part = trim(rest.substr(0, end));
        int value = 0;
        if (parse(part, value) && value >= low && value <= high)
            result.push_back(value);
        else
            problem(entry.line,
                    entry.value_column +
                        static_cast<int>(rest.data() - std::string_view(entry.value).data()),
                    "\"" + std::string(part) + "\" in " + entry.key,
                    "expected whole numbers from " + range_text(low, high) +
                        " separated by commas");
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return result;
}

double WifText::number(const WifEntry &entry, double low, double high) {
    double value = 0;
    if (parse(entry.value, value) && value >= low && value <= high)
        return value;
    value_problem(entry, entry.key + " is \"" + entry.value + "\"",
                  "expected a number from " + range_text(low, high));
    return low;
}

bool WifText::flag(const WifEntry &entry) {
    const std::string value = lower_case(entry.value);
    for (const char *yes : {"true", "yes", "on", "1"})
        if (value == yes)
            return true;
    for (const char *no : {"false", "no", "off", "0"})
        if (value == no)
            return false;
    value_problem(entry, entry.key + " is \"" + entry.value + "\"", "expected true or false");
    return false;
}

int WifText::key_number(const WifEntry &entry, int high) {
    int value = 0;
    if (parse(entry.key, value) && value >= 1 && value <= high)
        return value;
    problem(entry.line, entry.key_column, "key \"" + entry.key + "\"",
            "expected a number from " + range_text(1, high));
    return 0;
}

} // namespace tsuya::lab::detail

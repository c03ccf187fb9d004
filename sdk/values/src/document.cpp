#include "tsuya/sdk/document.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <set>

#include <toml++/toml.h>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/text.h"

namespace tsuya {

struct detail::DocumentState {
    std::string file;
    toml::table root;
    Problems problems;
    std::map<const toml::table *, std::set<std::string, std::less<>>> asked;
    std::set<const toml::table *> open; ///< tables whose keys are not judged

    std::string place(const toml::source_region &source) const {
        return file + ":" + std::to_string(source.begin.line) + ":" +
               std::to_string(source.begin.column);
    }
};

namespace {

const toml::table &table_of(const void *table) { return *static_cast<const toml::table *>(table); }

void find_unknown(const detail::DocumentState &state, const toml::table &table,
                  Problems &problems) {
    const auto asked = state.asked.find(&table);
    if (asked == state.asked.end() || state.open.contains(&table))
        return;
    const std::vector<std::string> known(asked->second.begin(), asked->second.end());
    for (const auto &[key, node] : table) {
        const std::string name(key.str());
        if (!asked->second.contains(name))
            problems.add({"unknown key '" + name + "'", state.place(key.source()),
                          accepted_names(name, known)});
        else if (const toml::table *inner = node.as_table())
            find_unknown(state, *inner, problems);
        else if (const toml::array *list = node.as_array())
            for (const toml::node &element : *list)
                if (const toml::table *of_list = element.as_table())
                    find_unknown(state, *of_list, problems);
    }
}

/// A text that is a value, or one in an array, contains `part`.
bool has_text(const toml::node &node, const std::string &part) {
    if (const toml::array *const array = node.as_array())
        return std::any_of(array->begin(), array->end(),
                           [&](const toml::node &element) { return has_text(element, part); });
    const auto text = node.value_exact<std::string>();
    return text && text->find(part) != std::string::npos;
}

/// As a key stands in the name of a table: in quotes where it is not a bare one.
std::string key_text(std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
        return c == '_' || c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
               (c >= 'A' && c <= 'Z');
    });
    return bare ? std::string(key) : "\"" + std::string(key) + "\"";
}

} // namespace

Document::Document(const std::filesystem::path &file)
    : state_(std::make_unique<detail::DocumentState>()) {
    state_->file = file.string();
    const std::string text = read_text(file, OddBytes::refuse);
    try {
        state_->root = toml::parse(text);
    } catch (const toml::parse_error &error) {
        throw Error({std::string(error.description()), state_->place(error.source()),
                     "expected a TOML file"});
    }
}

Document::~Document() = default;

Section Document::root() const { return Section(state_.get(), &state_->root, ""); }

void Document::finish() const {
    Problems problems = state_->problems;
    find_unknown(*state_, state_->root, problems);
    problems.throw_if_any();
}

std::string Section::full_name(std::string_view key) const {
    return name_.empty() ? key_text(key) : name_ + "." + key_text(key);
}

bool Section::has(std::string_view key) const {
    state_->asked[&table_of(table_)].insert(std::string(key));
    return table_of(table_).contains(key);
}

bool Section::is_text(std::string_view key) const {
    const toml::node *const node = table_of(table_).get(key);
    return node && node->is_string();
}

std::string Section::where(std::string_view key) const {
    const toml::table &table = table_of(table_);
    if (const toml::node *node = key.empty() ? nullptr : table.get(key))
        return state_->place(node->source());
    return table.source().begin ? state_->place(table.source()) : state_->file + ":1:1";
}

std::vector<Section> Section::list(std::string_view key) const {
    if (!has(key))
        return {};
    const toml::array *const array = table_of(table_).get(key)->as_array();
    std::vector<Section> all;
    for (std::size_t i = 0; array && i < array->size(); ++i)
        if (const toml::table *const table = array->get(i)->as_table()) {
            state_->asked[table];
            all.push_back(Section(state_, table, full_name(key)));
        }
    if (array && !array->empty() && all.size() == array->size())
        return all;
    problem(key, "'" + std::string(key) + "' is no list of tables",
            "expected [[" + full_name(key) + "]]");
    return {};
}

void Section::leave_unjudged() const { state_->open.insert(&table_of(table_)); }

void Section::problem(std::string_view key, std::string what, std::string accepted) const {
    state_->problems.add({std::move(what), where(key), std::move(accepted)});
}

void Section::problem(std::string_view key, const Error &error) const {
    for (const Problem &p : error.problems()) {
        const toml::node *const value = table_of(table_).get(key);
        const bool placed = p.where.find_first_of(":/") != std::string::npos ||
                            (p.where.find('.') != std::string::npos && value &&
                             has_text(*value, p.where)); // a file in the working folder
        problem(key, (placed ? p.where + ": " : "") + p.what, p.accepted);
    }
}

std::optional<std::string> Section::text(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    if (auto value = table_of(table_).get(key)->value_exact<std::string>())
        return value;
    problem(key, "'" + std::string(key) + "' is not a text", "expected a text in quotes");
    return std::nullopt;
}

std::string Section::required_text(std::string_view key) const {
    if (!has(key))
        problem(key, "'" + std::string(key) + "' is missing", "expected a text in quotes");
    return text(key).value_or("");
}

std::optional<double> Section::number(std::string_view key, double low, double high) const {
    if (!has(key))
        return std::nullopt;
    const toml::node &node = *table_of(table_).get(key);
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (value && std::isfinite(*value) && *value >= low && *value <= high)
        return value;
    const auto shown = [](double v) { // the shortest text that is this number
        std::array<char, 32> text{};
        return std::string(text.data(), std::to_chars(text.begin(), text.end(), v).ptr);
    };
    std::string accepted = "expected a number";
    if (low > -1e300 && high < 1e300)
        accepted += " from " + shown(low) + " to " + shown(high);
    else if (low > -1e300)
        accepted += " not below " + shown(low);
    problem(key, "'" + std::string(key) + "' is " + (value ? shown(*value) : "not a number"),
            std::move(accepted));
    return std::nullopt;
}

double Section::required_number(std::string_view key, double low, double high) const {
    if (!has(key))
        problem(key, "'" + std::string(key) + "' is missing", "expected a number");
    return number(key, low, high).value_or(std::clamp(1.0, low, high));
}

std::optional<std::int64_t> Section::whole_number(std::string_view key, std::int64_t low,
                                                  std::int64_t high) const {
    if (!has(key))
        return std::nullopt;
    const auto value = table_of(table_).get(key)->value_exact<std::int64_t>();
    if (value && *value >= low && *value <= high)
        return value;
    problem(key,
            "'" + std::string(key) + "' is " + (value ? std::to_string(*value) : "not an integer"),
            "expected an integer from " + std::to_string(low) + " to " + std::to_string(high));
    return std::nullopt;
}

std::optional<bool> Section::flag(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    if (const auto value = table_of(table_).get(key)->value_exact<bool>())
        return value;
    problem(key, "'" + std::string(key) + "' is neither true nor false", "expected true or false");
    return std::nullopt;
}

std::optional<std::vector<double>> Section::numbers(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const toml::array *array = table_of(table_).get(key)->as_array();
    std::vector<double> values;
    for (std::size_t i = 0; array && i < array->size(); ++i) {
        const toml::node &node = *array->get(i);
        const auto value = node.is_number() ? node.value<double>() : std::nullopt;
        if (value && std::isfinite(*value))
            values.push_back(*value);
    }
    if (array && values.size() == array->size())
        return values;
    problem(key, "'" + std::string(key) + "' is not an array of finite numbers",
            "expected such as [0.5, 1.0]");
    return std::nullopt;
}

std::optional<glm::dvec3> Section::vector(std::string_view key) const {
    const auto values = numbers(key);
    if (values && values->size() == 3)
        return glm::dvec3((*values)[0], (*values)[1], (*values)[2]);
    if (values)
        problem(key, "'" + std::string(key) + "' has " + detail::counted(values->size(), "number"),
                "expected three, x, y and z");
    return std::nullopt;
}

std::optional<std::vector<std::string>> Section::texts(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    const toml::array *array = table_of(table_).get(key)->as_array();
    std::vector<std::string> values;
    for (std::size_t i = 0; array && i < array->size(); ++i)
        if (const auto value = array->get(i)->value_exact<std::string>())
            values.push_back(*value);
    if (array && values.size() == array->size())
        return values;
    problem(key, "'" + std::string(key) + "' is not an array of texts",
            "expected such as [\"D65\", \"A\"]");
    return std::nullopt;
}

std::vector<std::pair<std::string, std::string>> Section::all_texts() const {
    state_->open.insert(&table_of(table_));
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto &[key, node] : table_of(table_)) {
        if (const auto value = text(key.str()))
            all.emplace_back(key.str(), *value);
    }
    return all;
}

std::optional<Section> Section::section(std::string_view key) const {
    if (!has(key))
        return std::nullopt;
    if (const toml::table *table = table_of(table_).get(key)->as_table()) {
        state_->asked[table];
        return Section(state_, table, full_name(key));
    }
    problem(key, "'" + std::string(key) + "' is not a table", "expected [" + full_name(key) + "]");
    return std::nullopt;
}

std::vector<std::pair<std::string, Section>> Section::sections() const {
    std::vector<std::pair<std::string, Section>> all;
    for (const auto &[key, node] : table_of(table_))
        if (const auto inner = section(key.str()))
            all.emplace_back(key.str(), *inner);
    std::sort(all.begin(), all.end(), [](const auto &a, const auto &b) {
        return table_of(a.second.table_).source().begin.line <
               table_of(b.second.table_).source().begin.line;
    });
    return all;
}

} // namespace tsuya

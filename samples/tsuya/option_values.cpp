// Words of a call to values of fields.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <type_traits>

#include "options.h"
#include "same_file.h"
#include "tsuya/sdk/detail/counted.h"

namespace tsuya::program {
namespace {

template <class T> struct ElementOf {
    using Type = T;
    static constexpr bool kList = false;
};
template <class T> struct ElementOf<std::optional<T>> : ElementOf<T> {};
template <class T> struct ElementOf<std::vector<T>> {
    using Type = T;
    static constexpr bool kList = true;
};

std::string text_of(double value) {
    std::ostringstream text;
    text.precision(15);
    text << value;
    return text.str();
}

std::string text_of(const std::string &value) { return value; }
std::string text_of(const std::filesystem::path &value) { return value.string(); }

template <class T> std::string text_of(const std::optional<T> &value) {
    return value ? text_of(*value) : "";
}

template <class T> std::string text_of(const std::vector<T> &values) {
    std::string text;
    for (const T &value : values)
        text += (text.empty() ? "" : ",") + text_of(value);
    return text;
}

[[noreturn]] void refuse(const Option &option, const std::string &what) {
    const std::string accepted = accepted_by(option);
    throw WrongCall({what, name_of(option), accepted.empty() ? "" : "expected " + accepted});
}

template <class T> std::optional<T> parsed(std::string_view word) {
    if (word.starts_with('+'))
        word.remove_prefix(1);
    T value{};
    const char *const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, value);
    return error == std::errc{} && stop == end ? std::optional(value) : std::nullopt;
}

/// A finite number in the option's range.
double number_of(const Option &option, const std::string &word) {
    const std::optional<double> number = parsed<double>(word);
    if (!number)
        refuse(option, "'" + word + "' is not a number");
    if (!std::isfinite(*number))
        refuse(option, "'" + word + "' is not finite");
    const bool inside = (!option.least || *number > *option.least ||
                         (!option.is_open && *number == *option.least)) &&
                        (!option.most || *number <= *option.most);
    if (!inside)
        refuse(option, "'" + word + "' is out of range");
    return *number;
}

/// A whole number, also as `2e6`.
template <class T> T whole_number_of(const Option &option, const std::string &word) {
    constexpr double kExact = 9007199254740992.0; // doubles are whole numbers one by one up to 2^53
    const double number = number_of(option, word);
    if (const std::optional<T> exact = parsed<T>(word))
        return *exact;
    if (number != std::floor(number))
        refuse(option, "'" + word + "' is not a whole number");
    if (std::abs(number) > kExact || number > static_cast<double>(std::numeric_limits<T>::max()) ||
        number < static_cast<double>(std::numeric_limits<T>::min()))
        refuse(option, "'" + word + "' is out of range");
    return static_cast<T>(number);
}

bool may_name_file(const std::string &word) {
    std::error_code code;
    return std::filesystem::path(word).has_extension() || std::filesystem::exists(word, code);
}

void check_choice(const Option &option, const std::string &word) {
    const std::vector<std::string> &known = option.choices;
    if (known.empty() || std::find(known.begin(), known.end(), word) != known.end() ||
        (option.may_be_file && may_name_file(word)))
        return;
    throw WrongCall({"'" + word + "' is unknown", name_of(option),
                     accepted_names(word, known) + (option.may_be_file ? "; or a file" : "")});
}

template <class T> T value_of(const Option &option, const std::string &word) {
    if constexpr (std::is_same_v<T, double>) {
        return number_of(option, word);
    } else if constexpr (std::is_integral_v<T>) {
        const T value = whole_number_of<T>(option, word);
        check_choice(option, std::to_string(value));
        return value;
    } else {
        if (word.empty())
            throw WrongCall({"a value is empty", name_of(option), "expected " + option.value});
        check_choice(option, word);
        return T(word);
    }
}

template <class T> void set(const Option &option, T &field) {
    using Element = typename ElementOf<T>::Type;
    if constexpr (std::is_same_v<T, bool>) {
        field = true;
    } else if constexpr (ElementOf<T>::kList) {
        if (option.count && option.words.size() != *option.count)
            throw WrongCall({detail::counted(option.words.size(), "value") + " given",
                             name_of(option),
                             "expected " + std::to_string(*option.count) + ": " + option.value});
        field.clear();
        for (const std::string &word : option.words)
            field.push_back(value_of<Element>(option, word));
    } else {
        if (option.words.size() > 1)
            throw WrongCall({"it is given " + std::to_string(option.words.size()) + " times",
                             name_of(option), "expected it once"});
        field = value_of<Element>(option, option.words.front());
    }
}

template <class T> bool is_whole() {
    return std::is_integral_v<typename ElementOf<T>::Type> && !std::is_same_v<T, bool>;
}

template <class T> bool is_number() {
    return std::is_arithmetic_v<typename ElementOf<T>::Type> && !std::is_same_v<T, bool>;
}

/// Throws WrongCall if another option forbids this one, or one that it needs is missing.
void check_company(const Option &option) {
    if (option.is_required && !option.given)
        throw WrongCall(
            {"it is missing", name_of(option),
             option.names.empty()
                 ? "expected " + (option.choices.empty() ? option.help : accepted_by(option))
                 : "expected " + name_of(option) + " " + option.value});
    if (!option.given)
        return;
    for (const Option *other : option.excluded)
        if (other->given)
            throw WrongCall({"it cannot be given with " + name_of(*other), name_of(option),
                             "expected one of the two"});
    for (const Option *other : option.needed)
        if (!other->given)
            throw WrongCall({"it has no meaning without " + name_of(*other), name_of(option),
                             "expected both or neither"});
}

bool names_file(const Option &option) {
    return option.may_be_file || std::visit(
                                     []<class T>(const T *) {
                                         using Element = typename ElementOf<T>::Type;
                                         return std::is_same_v<Element, std::filesystem::path>;
                                     },
                                     option.field);
}

/// Throws WrongCall if the result would replace a file of another option.
void check_result(const Option &result, const std::deque<Option> &all) {
    for (const Option &other : all)
        for (const std::string &word : other.words)
            if (&other != &result && names_file(other) && is_same_file(result.words.front(), word))
                throw WrongCall({"it would replace the file of " + name_of(other), name_of(result),
                                 "expected another name"});
}

void check_extension(const Option &result) {
    const std::string &word = result.words.front(),
                      extension = std::filesystem::path(word).extension();
    const std::vector<std::string> &known = result.extensions;
    if (known.empty() || std::find(known.begin(), known.end(), extension) != known.end())
        return;
    std::string accepted;
    for (const std::string &one : known)
        accepted += (accepted.empty() ? "" : " or ") + one;
    throw WrongCall({(extension.empty() ? "the name has no extension: "
                                        : "files of type '" + extension + "' are not written: ") +
                         word,
                     name_of(result), "expected a name that ends in " + accepted});
}

/// Throws WrongCall for what the command's own rules refuse.
void check_rules(const Option &option) {
    try {
        for (const std::function<void()> &rule : option.rules)
            rule();
    } catch (const Error &error) {
        throw WrongCall(error.at(name_of(option)).problems());
    }
}

} // namespace

std::string name_of(const Option &option) {
    if (!option.called.empty())
        return option.called;
    return option.names.empty() ? option.value
                                : option.names.substr(option.names.find_last_of(',') + 1);
}

std::string range_of(const Option &option) {
    if (!option.choices.empty()) {
        std::string text;
        for (const std::string &choice : option.choices)
            text += (text.empty() ? "" : ", ") + choice;
        return text;
    }
    if (!option.least)
        return "";
    if (std::isinf(*option.most))
        return (option.is_open ? "above " : "at least ") + text_of(*option.least);
    if (option.is_open)
        return "above " + text_of(*option.least) + ", at most " + text_of(*option.most);
    return text_of(*option.least) + " to " + text_of(*option.most);
}

std::string accepted_by(const Option &option) {
    std::string range = range_of(option);
    return std::visit(
        [&]<class T>(const T *) -> std::string {
            using Element = typename ElementOf<T>::Type;
            if (!is_number<T>() || !option.choices.empty())
                return range;
            std::string text = is_whole<T>() ? "a whole number" : "a number";
            if (option.count)
                text =
                    std::to_string(*option.count) + (is_whole<T>() ? " whole numbers" : " numbers");
            if (!range.empty())
                return text + (option.is_open || std::isinf(*option.most) ? " " : " from ") + range;
            if constexpr (std::is_unsigned_v<Element>)
                text += " from 0 to " + std::to_string(std::numeric_limits<Element>::max());
            return text;
        },
        option.field);
}

std::string default_of(const Option &option) {
    return std::visit(
        [&]<class T>(const T *field) -> std::string {
            if constexpr (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>)
                if (option.least && static_cast<double>(*field) < *option.least)
                    return ""; // stands for none
            if constexpr (std::is_same_v<T, bool>)
                return "";
            else if constexpr (std::is_integral_v<T>)
                return std::to_string(*field);
            else
                return text_of(*field);
        },
        option.field);
}

bool is_flag(const Option &option) { return std::holds_alternative<bool *>(option.field); }

bool is_list(const Option &option) {
    return std::visit([]<class T>(const T *) { return ElementOf<T>::kList; }, option.field);
}

Option &Option::required() {
    is_required = true;
    return *this;
}

Option &Option::range(double first, double last, bool open) {
    least = first;
    most = last;
    is_open = open;
    return *this;
}

Option &Option::one_of(std::vector<std::string> values) {
    choices = std::move(values);
    return *this;
}

Option &Option::with_commas() {
    has_commas = true;
    return *this;
}

Option &Option::with_words() {
    has_words = true;
    return *this;
}

Option &Option::exactly(std::size_t number) {
    count = number;
    return *this;
}

Option &Option::result(std::vector<std::string> of_type) {
    is_result = true;
    extensions = std::move(of_type);
    return *this;
}

Option &Option::or_file() {
    may_be_file = true;
    return *this;
}

Option &Option::check(std::function<void()> rule) {
    rules.push_back(std::move(rule));
    return *this;
}

Option &Option::needs(const Option &other) {
    needed.push_back(&other);
    return *this;
}

Option &Option::excludes(const Option &other) {
    excluded.push_back(&other);
    return *this;
}

Option &Options::argument(Field field, std::string value, std::string help) {
    return option("", field, std::move(value), std::move(help));
}

Option &Options::option(std::string names, Field field, std::string value, std::string help) {
    return all_.emplace_back(Option{std::move(names), field, std::move(value), std::move(help)});
}

Option &Options::flag(std::string names, bool *field, std::string help) {
    return option(std::move(names), field, "", std::move(help));
}

void Options::one_of(Option &first, Option &second) {
    first.excludes(second);
    second.excludes(first);
    one_of_.emplace_back(&first, &second);
}

void Options::fill_fields() const {
    for (const Option &option : all_)
        check_company(option);
    for (const auto &[first, second] : one_of_)
        if (!first->given && !second->given)
            throw WrongCall(
                {"neither " + name_of(*first) + " nor " + name_of(*second) + " is given", "",
                 "expected one of the two"});
    for (const Option &option : all_)
        if (option.is_result && option.given)
            check_result(option, all_);
    for (const Option &option : all_)
        if (option.given)
            std::visit([&](auto *field) { set(option, *field); }, option.field);
    for (const Option &option : all_)
        if (option.is_result && option.given)
            check_extension(option);
    for (const Option &option : all_)
        check_rules(option);
}

} // namespace tsuya::program

#include "help.h"

#include <algorithm>
#include <sstream>
#include <vector>

namespace tsuya::program {
namespace {

constexpr std::size_t kWidth = 100;
constexpr std::size_t kColumn = 28; // where descriptions begin

/// The words of a text in lines of `kWidth`, each after the first behind `indent` spaces; the first
/// begins at column `at`. Line breaks of the text stay.
std::string wrapped(const std::string &text, std::size_t at, std::size_t indent) {
    std::string out;
    std::istringstream lines(text);
    bool first_line = true;
    for (std::string line; std::getline(lines, line);) {
        if (!first_line) {
            out += "\n" + std::string(indent, ' ');
            at = indent;
        }
        first_line = false;
        std::istringstream words(line);
        bool first_word = true;
        for (std::string word; words >> word; first_word = false) {
            if (!first_word && at + 1 + word.size() > kWidth) {
                out += "\n" + std::string(indent, ' ');
                at = indent;
            } else if (!first_word) {
                out += " ";
                ++at;
            }
            out += word;
            at += word.size();
        }
    }
    return out;
}

/// `  name   description`; a long name has a line of its own.
std::string entry(const std::string &name, const std::string &description) {
    std::string text = "  " + name;
    if (text.size() + 2 > kColumn)
        text += "\n" + std::string(kColumn, ' ');
    else
        text.resize(kColumn, ' ');
    return text + wrapped(description, kColumn, kColumn) + "\n";
}

std::string joined(const std::vector<std::string> &parts, const char *between) {
    std::string text;
    for (const std::string &part : parts)
        text += (text.empty() ? "" : between) + part;
    return text;
}

std::string spelled(const Option &option) {
    std::string text = option.names;
    for (std::size_t comma = text.find(','); comma != std::string::npos;
         comma = text.find(',', comma + 2))
        text.insert(comma + 1, " ");
    return text + (text.empty() || option.value.empty() ? "" : " ") + option.value;
}

std::string names_of(const std::vector<const Option *> &options) {
    std::vector<std::string> names;
    for (const Option *option : options)
        names.push_back(name_of(*option));
    return joined(names, ", ");
}

/// The help of an option with its rules in brackets.
std::string described(const Option &option) {
    std::vector<std::string> rules;
    if (option.is_required && !option.names.empty())
        rules.push_back("required");
    if (const std::string range = range_of(option); !range.empty())
        rules.push_back(range);
    if (const std::string value = default_of(option); !value.empty())
        rules.push_back("default " + value);
    if (!option.needed.empty())
        rules.push_back("only with " + names_of(option.needed));
    if (!option.excluded.empty())
        rules.push_back("not with " + names_of(option.excluded));
    return option.help + (rules.empty() ? "" : " (" + joined(rules, "; ") + ")");
}

std::string list_of(const Options &options) {
    std::string arguments, others;
    for (const Option &option : options.all())
        (option.names.empty() ? arguments : others) += entry(spelled(option), described(option));
    return (arguments.empty() ? "" : "\nArguments:\n" + arguments) + "\nOptions:\n" + others;
}

std::string example_of(const Options &options) {
    std::istringstream lines(options.example());
    std::string text;
    for (std::string line; std::getline(lines, line);)
        text += "  " + line + "\n";
    return "\nExample:\n" + text;
}

std::string usage_of(const CommandEntry &entry, const Options &options) {
    std::vector<std::string> parts{"Usage: tsuya", entry.name};
    for (const Option &option : options.all())
        if (option.names.empty())
            parts.push_back(option.is_required ? option.value : "[" + option.value + "]");
    for (const Option &option : options.all())
        if (option.is_required && !option.names.empty())
            parts.push_back(option.names.substr(0, option.names.find(',')) + " " + option.value);
    parts.emplace_back("[OPTIONS]");
    return joined(parts, " ") + "\n";
}

bool in_group(const CommandEntry &entry) {
    return std::string_view(entry.name).find(' ') != std::string_view::npos;
}

std::string help_entry() { return entry("-h, --help", "print this help"); }

} // namespace

std::string help_of_program(std::span<const CommandEntry> table, const Options &common) {
    std::string commands;
    for (const CommandEntry &line : table)
        if (!in_group(line))
            commands += entry(line.name, line.about);
    return "Renders garments of silk-like woven fabric under any lamp.\n"
           "Usage: tsuya COMMAND [OPTIONS]\n\nCommands:\n" +
           commands + list_of(common) + help_entry() + entry("--version", "print the version") +
           example_of(common) + "`tsuya COMMAND --help` has all its options.\n\n" +
           wrapped(common.notes(), 0, 0) + "\n";
}

std::string help_of_group(const CommandEntry &group, std::span<const CommandEntry> commands,
                          const Options &first) {
    std::string list;
    for (const CommandEntry &line : commands)
        list +=
            entry(std::string(line.name).substr(std::string(group.name).size() + 1), line.about);
    return std::string(group.about) + "\nUsage: tsuya " + group.name +
           " COMMAND [OPTIONS]\n\nCommands:\n" + list + example_of(first);
}

std::string help_of_command(const CommandEntry &command, const Options &options) {
    return std::string(command.about) + "\n" + usage_of(command, options) + list_of(options) +
           help_entry() +
           entry("--progress MODE", "how progress is reported on stderr; see `tsuya --help`") +
           example_of(options) +
           (options.notes().empty() ? "" : wrapped(options.notes(), 0, 0) + "\n");
}

} // namespace tsuya::program

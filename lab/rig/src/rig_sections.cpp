#include "rig_sections.h"

#include <algorithm>

namespace tsuya::lab {
namespace {

/// The placeholders in a word; notes a brace that begins or ends none.
void add_placeholders(const Section &section, const std::string &word,
                      std::set<std::string> &found) {
    std::size_t at = 0;
    while ((at = word.find_first_of("{}", at)) != std::string::npos) {
        const std::size_t end = word.find_first_of("{}", at + 1);
        if (word[at] != '{' || end == std::string::npos || word[end] != '}') {
            section.problem("command", "a brace without its other in '" + word + "'",
                            "expected such as {file}");
            return;
        }
        found.insert(word.substr(at + 1, end - at - 1));
        at = end + 1;
    }
}

} // namespace

std::optional<std::size_t> index_of(const std::string &name,
                                    const std::vector<std::string> &known) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end())
        return std::nullopt;
    return static_cast<std::size_t>(at - known.begin());
}

std::size_t read_choice(const Section &section, const char *key,
                        const std::vector<std::string> &names, bool required) {
    if (!section.is_text(key)) { // absent, or with a problem that the getter notes
        if (required)
            section.required_text(key);
        else
            section.text(key);
        return 0;
    }
    const std::string name = section.required_text(key);
    const auto index = index_of(name, names);
    if (!index)
        section.problem(key, "unknown " + std::string(key) + " '" + name + "'",
                        accepted_names(name, names));
    return index.value_or(0);
}

std::optional<Section> required_section(const Section &root, const char *key) {
    if (!root.has(key))
        root.problem("", "there is no [" + std::string(key) + "]",
                     "expected [" + std::string(key) + "]");
    return root.section(key);
}

std::vector<std::string> read_command(const Section &section, const std::set<std::string> &known,
                                      const std::set<std::string> &needed) {
    std::vector<std::string> command =
        section.texts("command").value_or(std::vector<std::string>{});
    if (!section.has("command") || command.empty() || command.front().empty()) {
        section.problem("command", "there is no command", "expected [\"program\", \"argument\"]");
        return command;
    }
    std::set<std::string> found;
    for (const std::string &word : command)
        add_placeholders(section, word, found);
    const std::vector<std::string> names(known.begin(), known.end());
    for (const std::string &name : found)
        if (!known.contains(name))
            section.problem("command", "unknown placeholder {" + name + "}",
                            accepted_names(name, names));
    for (const std::string &name : needed)
        if (!found.contains(name))
            section.problem("command", "the command lacks {" + name + "}",
                            "expected it in one of the words");
    return command;
}

} // namespace tsuya::lab

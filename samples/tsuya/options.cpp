// The only file that knows CLI11: it splits the words of a call among a command's options. Its
// header takes seconds to compile; rules, values and help are in the files beside.

#include "options.h"

#include <algorithm>

#include <CLI/CLI.hpp>

#include "command.h"
#include "help.h"

namespace tsuya::program {
namespace {

/// A command or a group with its parser.
struct Node {
    const CommandEntry *entry = nullptr; ///< null: the program itself
    CLI::App *app = nullptr;
    Node *group = nullptr;
    std::unique_ptr<Command> command{};
    Options options{};
};

/// All values of the words, the empty ones, too.
std::vector<std::string> split_at_commas(const std::vector<std::string> &words) {
    std::vector<std::string> values;
    for (const std::string &word : words)
        for (std::size_t begin = 0, end = 0; begin <= word.size(); begin = end + 1) {
            end = std::min(word.find(',', begin), word.size());
            values.push_back(word.substr(begin, end - begin));
        }
    return values;
}

void declare(CLI::App &app, Option &option, const std::string &name) {
    if (is_flag(option)) {
        app.add_flag_function(name, [&option](std::int64_t times) { option.given = times > 0; });
        return;
    }
    CLI::Option *const made = app.add_option(name, [&option](const CLI::results_t &words) {
        option.given = true;
        option.words = option.has_commas ? split_at_commas(words) : words;
        return true;
    });
    made->type_name(option.value);
    made->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    if (is_list(option))
        made->expected(1, CLI::detail::expected_max_vector_size)
            ->allow_extra_args(option.has_words);
}

/// Notes the long name by which an option with several was called, for messages about it.
void note_called_name(Option &option, int argc, const char *const *argv) {
    for (std::size_t begin = 0, end = 0; end < option.names.size(); begin = end + 1) {
        end = std::min(option.names.find(',', begin), option.names.size());
        const std::string name = option.names.substr(begin, end - begin);
        for (int i = 1; name.starts_with("--") && i < argc; ++i)
            if (argv[i] == name || std::string_view(argv[i]).starts_with(name + "="))
                option.called = name;
    }
}

void declare(CLI::App &app, Options &options) {
    int arguments = 0;
    for (Option &option : options.all())
        declare(app, option,
                option.names.empty() ? "argument" + std::to_string(++arguments) : option.names);
}

class Parser {
  public:
    explicit Parser(std::span<const CommandEntry> table) : table_(table) {
        Node &program = nodes_.emplace_back();
        program.app = &app_;
        app_.fallthrough();
        app_.require_subcommand(0, 1);
        app_.allow_extras(); // unknown words are told in our own way
        app_.set_version_flag("--version", "tsuya " TSUYA_VERSION);
        program.options
            .option("--progress", &progress_, "MODE",
                    "how progress is reported on stderr: a bar where that is a terminal, lines of "
                    "text, lines of JSON, not at all")
            .one_of({"auto", "plain", "json", "off"});
        program.options.example("tsuya tryon -o out        the sample dress under three lamps");
        program.options.notes("Exit status: 0 done; 1 the input is wrong; 2 the call is wrong; 3 "
                              "interrupted, what was done is saved; 4 the check that was asked for "
                              "did not pass.");
        declare(app_, program.options);
        for (const CommandEntry &entry : table)
            add(entry);
    }

    Call parse(int argc, const char *const *argv) {
        try {
            app_.parse(argc, argv);
        } catch (const CLI::CallForVersion &version) {
            return {.text = std::string(version.what()) + "\n"};
        } catch (const CLI::CallForHelp &) {
            refuse_unknown_command(called());
            return {.text = help_of(called())};
        } catch (const CLI::ArgumentMismatch &error) { // its text begins with the option's name
            const std::string text = error.what();
            throw WrongCall(
                {"its value is missing", text.substr(0, text.find(':')), see_help(called())});
        } catch (const CLI::ParseError &error) {
            throw WrongCall({error.what(), "", see_help(called())});
        }
        Node &node = called();
        refuse_leftovers(node);
        for (Option &option : node.options.all())
            note_called_name(option, argc, argv);
        nodes_.front().options.fill_fields();
        node.options.fill_fields();
        return {.command = std::move(node.command),
                .progress = progress_,
                .options = std::move(node.options)};
    }

  private:
    void add(const CommandEntry &entry) {
        const std::string name = entry.name;
        const std::size_t space = name.find(' ');
        Node *group = &nodes_.front();
        for (Node &node : nodes_)
            if (space != std::string::npos && node.entry &&
                name.substr(0, space) == node.entry->name)
                group = &node;
        CLI::App *const app =
            group->app->add_subcommand(space == std::string::npos ? name : name.substr(space + 1));
        app->require_subcommand(0, 1);
        app->allow_extras();
        Node &node = nodes_.emplace_back(Node{.entry = &entry, .app = app, .group = group});
        if (!entry.make)
            return;
        node.command = entry.make();
        node.command->options(node.options);
        declare(*app, node.options);
    }

    /// The node that the call names last.
    Node &called() {
        Node *deepest = &nodes_.front();
        for (Node &node : nodes_)
            if (node.app->parsed() && node.entry)
                deepest = &node;
        return *deepest;
    }

    std::vector<CommandEntry> members(const Node &group) const {
        std::vector<CommandEntry> entries;
        for (const Node &node : nodes_)
            if (node.group == &group)
                entries.push_back(*node.entry);
        return entries;
    }

    std::vector<std::string> names_of_members(const Node &group) const {
        std::vector<std::string> names;
        for (const CommandEntry &entry : members(group)) {
            const std::string name = entry.name;
            names.push_back(name.substr(name.find(' ') + 1));
        }
        return names;
    }

    std::string help_of(const Node &node) const {
        if (!node.entry)
            return help_of_program(table_, node.options);
        if (node.entry->make)
            return help_of_command(*node.entry, node.options);
        const auto first = std::find_if(nodes_.begin(), nodes_.end(),
                                        [&](const Node &n) { return n.group == &node; });
        return help_of_group(*node.entry, members(node), first->options);
    }

    static std::string see_help(const Node &node) {
        return "see `tsuya " + (node.entry ? node.entry->name + std::string(" ") : "") + "--help`";
    }

    /// Throws WrongCall for words that no option took, and where no command is named.
    void refuse_leftovers(const Node &node) const {
        const std::vector<std::string> words = app_.remaining(true);
        if (words.empty()) {
            if (!node.command)
                throw WrongCall(
                    {"no command is named", "", accepted_names("", names_of_members(node))});
        } else if (words.front().starts_with('-')) {
            refuse_option(node, words.front().substr(0, words.front().find('=')));
        } else {
            refuse_unknown_command(node);
            throw WrongCall({"unexpected word '" + words.front() + "'", "", see_help(node)});
        }
    }

    void refuse_unknown_command(const Node &node) const {
        const std::vector<std::string> words = app_.remaining(true);
        if (!node.command && !words.empty() && !words.front().starts_with('-'))
            throw WrongCall({"unknown command '" + words.front() + "'", "",
                             accepted_names(words.front(), names_of_members(node))});
    }

    [[noreturn]] void refuse_option(const Node &node, const std::string &name) const {
        std::vector<std::string> known{"--help", "--version"};
        for (const Options *options : {&nodes_.front().options, &node.options})
            for (const Option &option : options->all())
                if (!option.names.empty())
                    known.push_back(name_of(option));
        const std::string nearest = nearest_name(name, known);
        throw WrongCall(
            {"unknown option " + name, "",
             (nearest.empty() ? "" : "did you mean " + nearest + "? ") + see_help(node)});
    }

    std::span<const CommandEntry> table_;
    CLI::App app_{"", "tsuya"};
    std::string progress_ = "auto";
    std::deque<Node> nodes_{}; // addresses stay
};

} // namespace

Call parse_call(std::span<const CommandEntry> table, int argc, const char *const *argv) {
    return Parser(table).parse(argc, argv);
}

} // namespace tsuya::program

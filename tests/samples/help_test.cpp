// What the program says of itself, and what the documents say of it.
#include <gtest/gtest.h>

#include <regex>
#include <set>

#include "samples/program_run.h"
#include "tsuya/sdk/file.h"

namespace tsuya::program {
namespace {

using scene::Scratch;

/// The names in a help's list of commands.
std::vector<std::string> listed_commands(const std::string &help) {
    std::vector<std::string> names;
    bool in_list = false;
    for (const std::string &line : lines_of(help)) {
        if (line.empty())
            in_list = false;
        const bool begins = line.size() > 2 && line.starts_with("  ") && line[2] != ' ';
        if (in_list && begins)
            names.push_back(line.substr(2, line.find(' ', 2) - 2));
        if (line == "Commands:")
            in_list = true;
    }
    return names;
}

/// All commands, `fabric fit` of the group `fabric`.
std::set<std::string> all_commands() {
    const Scratch scratch;
    std::set<std::string> commands;
    for (const std::string &name : listed_commands(run(scratch, {"--help"}).out)) {
        const std::vector<std::string> members =
            listed_commands(run(scratch, {name, "--help"}).out);
        for (const std::string &member : members)
            commands.insert(name + " " + member);
        if (members.empty())
            commands.insert(name);
    }
    return commands;
}

TEST(Help, TellsTheVersionAndEachCommand) {
    const Scratch scratch;
    EXPECT_EQ(run(scratch, {"--version"}).out.rfind("tsuya ", 0), 0u);
    const Outcome help = run(scratch, {"--help"});
    EXPECT_EQ(help.status, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_EQ(listed_commands(help.out),
              (std::vector<std::string>{"tryon", "render", "relight", "compare", "aovs", "fabric",
                                        "garment", "lab", "list"}));
    for (const std::string &command : all_commands()) {
        std::vector<std::string> call{command.substr(0, command.find(' '))};
        if (command.find(' ') != std::string::npos)
            call.push_back(command.substr(command.find(' ') + 1));
        call.emplace_back("--help");
        const Outcome of_command = run(scratch, call);
        EXPECT_EQ(of_command.status, 0) << command;
        EXPECT_NE(of_command.out.find("Example:\n  tsuya " + command), std::string::npos)
            << of_command.out;
    }
}

// The README's table has a row for each command of the program, and for no other.
TEST(Help, TheReadmeListsTheCommandsThatThereAre) {
    const std::string readme = read_file(TSUYA_SAMPLES_README);
    const std::size_t begin = readme.find("| command | does |");
    ASSERT_NE(begin, std::string::npos);
    const std::set<std::string> commands = all_commands();
    std::set<std::string> rows;
    const std::regex row("^\\| `tsuya ([a-z]+)( ([a-z]+))?.*");
    for (const std::string &line :
         lines_of(readme.substr(begin, readme.find("\n\n", begin) - begin))) {
        std::smatch match;
        if (std::regex_match(line, match, row))
            rows.insert(commands.contains(match[1]) ? match[1].str()
                                                    : match[1].str() + match[2].str());
    }
    EXPECT_EQ(rows, commands);
}

} // namespace
} // namespace tsuya::program

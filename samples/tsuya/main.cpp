// The program `tsuya`: parses, calls the SDK, prints.

#include <algorithm>
#include <iostream>
#include <vector>

#include "command.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya;
using namespace tsuya::program;

constexpr const char *kAbout =
    "Renders garments of silk-like woven fabric under any lamp.\n"
    "Exit status: 0 done; 1 the input is wrong; 2 the call is wrong; 3 interrupted, what was done "
    "is saved;\n4 the check that was asked for did not pass.";

std::vector<std::unique_ptr<Command>> make_commands(CLI::App &app) {
    std::vector<std::unique_ptr<Command>> commands;
    for (const auto make : {make_tryon, make_render, make_relight, make_compare, make_fabric,
                            make_garment, make_lab, make_list})
        commands.push_back(make(app));
    return commands;
}

/// The first word names no command: says so better than the parser can.
bool is_unknown_command(const CLI::App &app, int argc, char **argv, Console &console) {
    if (argc < 2 || argv[1][0] == '-')
        return false;
    std::vector<std::string> known;
    for (const CLI::App *command : app.get_subcommands([](const CLI::App *) { return true; }))
        known.push_back(command->get_name());
    if (std::find(known.begin(), known.end(), argv[1]) != known.end())
        return false;
    console.error("unknown command '" + std::string(argv[1]) + "'; " +
                  accepted_names(argv[1], known));
    return true;
}

int run(Command &command, Console &console) {
    watch_signals();
    try {
        const Status status = command.run(console);
        console.end_line();
        std::cout.flush();
        if (!std::cout) {
            console.error("the results could not be written to the standard output");
            return kWrongInput;
        }
        return status;
    } catch (const Error &error) {
        for (const Problem &problem : error.problems())
            console.error(problem);
        return kWrongInput;
    } catch (const Interrupted &interrupted) {
        console.error(interrupted.what());
        return kInterrupted;
    } catch (const std::exception &error) {
        console.error(std::string("internal error: ") + error.what());
        return kWrongInput;
    }
}

} // namespace

int main(int argc, char **argv) {
    Console console;
    CLI::App app(kAbout, "tsuya");
    app.set_version_flag("--version", "tsuya " TSUYA_VERSION);
    app.footer("Example:\n  tsuya tryon -o out        the sample dress under three lamps\n"
               "`tsuya COMMAND --help` tells more.");
    app.require_subcommand(1);
    app.fallthrough();
    std::string progress = "auto";
    app.add_option("--progress", progress, "How progress is told on stderr")
        ->check(CLI::IsMember({"auto", "plain", "json", "off"}))
        ->capture_default_str();
    const std::vector<std::unique_ptr<Command>> commands = make_commands(app);
    if (is_unknown_command(app, argc, argv, console))
        return kWrongCall;
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError &error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success))
            return app.exit(error);
        console.error(std::string(error.what()) + "; see --help");
        return kWrongCall;
    }
    console.set_mode(parse_progress_mode(progress));
    for (const std::unique_ptr<Command> &command : commands)
        if (command->called())
            return run(*command, console);
    return kWrongCall;
}

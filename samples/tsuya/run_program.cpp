// A call of the program from its words to its exit status.

#include <iostream>

#include "command.h"
#include "tsuya/sdk/error.h"

namespace tsuya::program {
namespace {

bool flushed(Console &console) {
    if (std::cout.flush())
        return true;
    console.error("the results could not be written to the standard output");
    return false;
}

int run(Command &command, Console &console) {
    try {
        const Status status = command.run(console);
        console.end_line();
        return flushed(console) ? status : kWrongInput;
    } catch (const WrongCall &wrong) { // rules that the options do not know
        console.errors(wrong);
        return kWrongCall;
    } catch (const Error &error) {
        console.errors(error);
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

int run_program(std::span<const CommandEntry> table, int argc, const char *const *argv) {
    watch_signals();
    Console console;
    try {
        const Call call = parse_call(table, argc, argv);
        console.set_mode(parse_progress_mode(call.progress));
        if (call.command)
            return run(*call.command, console);
        std::cout << call.text;
        return flushed(console) ? kDone : kWrongInput;
    } catch (const WrongCall &wrong) {
        console.errors(wrong);
        return kWrongCall;
    }
}

} // namespace tsuya::program

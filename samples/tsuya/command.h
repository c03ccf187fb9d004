#pragma once
// A command of the program: its options, and what it does with them.

#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "console.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::program {

/// What a process tells its caller.
enum Status : int {
    kDone = 0,
    kWrongInput = 1,
    kWrongCall = 2,
    kInterrupted = 3,
    kCheckFailed = 4,
};

/// Made with its options on the command line; run if it was called.
class Command {
  public:
    virtual ~Command() = default;
    virtual bool called() const = 0;
    /// \return what the process returns. Errors are thrown.
    virtual Status run(Console &console) = 0;
};

std::unique_ptr<Command> make_tryon(CLI::App &program);
std::unique_ptr<Command> make_render(CLI::App &program);
std::unique_ptr<Command> make_relight(CLI::App &program);
std::unique_ptr<Command> make_compare(CLI::App &program);
std::unique_ptr<Command> make_fabric(CLI::App &program);
std::unique_ptr<Command> make_garment(CLI::App &program);
std::unique_ptr<Command> make_lab(CLI::App &program);
std::unique_ptr<Command> make_list(CLI::App &program);

/// The commands of `tsuya fabric`.
std::unique_ptr<Command> make_fabric_fit(CLI::App &fabric);
std::unique_ptr<Command> make_fabric_evaluate(CLI::App &fabric);
std::unique_ptr<Command> make_fabric_show(CLI::App &fabric);
std::unique_ptr<Command> make_fabric_paper(CLI::App &fabric);
std::unique_ptr<Command> make_fabric_simulate(CLI::App &fabric);

} // namespace tsuya::program

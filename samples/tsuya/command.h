#pragma once
/// \file
/// A command of the program: its options, and what it does with them. How one is added: write a
/// source with a struct like those beside this file, declare its `make_` here, and give it a line
/// in the table of main.cpp.

#include <memory>
#include <span>
#include <string>

#include "console.h"
#include "options.h"

namespace tsuya::program {

/// The exit status of a process.
enum Status : int {
    kDone = 0,
    kWrongInput = 1,
    kWrongCall = 2,
    kInterrupted = 3,
    kCheckFailed = 4,
};

/// A struct of fields that options fill.
class Command {
  public:
    virtual ~Command() = default;
    /// Declares the options, each with the field that it fills. A field's value is the default.
    virtual void options(Options &options) = 0;
    /// \return what the process returns. Errors are thrown.
    virtual Status run(Console &console) = 0;
};

/// A line in the table of commands.
struct CommandEntry {
    const char *name;                   ///< `render`, or `fabric fit` in a group
    const char *about;                  ///< what it does, for the help of the whole program
    std::unique_ptr<Command> (*make)(); ///< null for a group, which comes before its commands
};

/// What the words of a call ask for.
struct Call {
    std::unique_ptr<Command> command{}; ///< with its fields filled; null: only `text` is printed
    std::string text{};                 ///< the help or the version
    std::string progress = "auto";      ///< see parse_progress_mode
    Options options{};                  ///< of the command, which may ask them what was given
};

/// Takes a call apart. Throws WrongCall.
Call parse_call(std::span<const CommandEntry> table, int argc, const char *const *argv);

/// Runs the command that a call asks for, or says what is wrong with the call. \return the exit
/// status of the process
int run_program(std::span<const CommandEntry> table, int argc, const char *const *argv);

std::unique_ptr<Command> make_tryon();
std::unique_ptr<Command> make_render();
std::unique_ptr<Command> make_relight();
std::unique_ptr<Command> make_compare();
std::unique_ptr<Command> make_aovs();
std::unique_ptr<Command> make_fabric_fit();
std::unique_ptr<Command> make_fabric_simulate();
std::unique_ptr<Command> make_fabric_evaluate();
std::unique_ptr<Command> make_fabric_show();
std::unique_ptr<Command> make_fabric_paper();
std::unique_ptr<Command> make_garment_check();
std::unique_ptr<Command> make_garment_export();
std::unique_ptr<Command> make_garment_subdivide();
std::unique_ptr<Command> make_lab_lines();
std::unique_ptr<Command> make_lab_measure();
std::unique_ptr<Command> make_lab_pulse();
std::unique_ptr<Command> make_lab_plan();
std::unique_ptr<Command> make_lab_run();
std::unique_ptr<Command> make_lab_resume();
std::unique_ptr<Command> make_lab_status();
std::unique_ptr<Command> make_lab_reset();
std::unique_ptr<Command> make_list();

} // namespace tsuya::program

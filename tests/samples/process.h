#pragma once
// The program as its users call it: arguments in, exit status and both streams out.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace tsuya::program {

struct Outcome {
    int status = -1; ///< exit status; -1 if a signal ended the process
    std::string out; ///< standard output
    std::string err; ///< standard error
};

/// Runs the program to its end. Where `interrupt_when` is given, SIGINT is sent once it becomes
/// true of what is on stderr so far.
/// \param scratch a folder for the streams
Outcome run_program(const std::vector<std::string> &arguments, const std::filesystem::path &scratch,
                    const std::function<bool(const std::string &err)> &interrupt_when = {});

} // namespace tsuya::program

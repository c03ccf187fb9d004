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

/// Runs the program to its end. Where `signal_for` is given, it is asked again and again with what
/// is on stderr so far, and the signal that it names is sent; 0: none.
/// \param scratch a folder for the streams
Outcome run_program(const std::vector<std::string> &arguments, const std::filesystem::path &scratch,
                    const std::function<int(const std::string &err)> &signal_for = {});

/// For run_program: the signal, once `text` is on stderr.
std::function<int(const std::string &err)> once(int signal, std::string text);

} // namespace tsuya::program

#pragma once
/// \file
/// Programs of others that a session runs: a camera's, a drive's.

#include <atomic>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "tsuya/lab/clock.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// How a program is run.
struct CommandRun {
    Seconds timeout{60};                     ///< then it and all that it started are killed
    const std::atomic<bool> *stop = nullptr; ///< may be null
    /// Called with the process group while the program runs, and 0 afterwards; may be empty.
    std::function<void(int group)> on_group{};
};

/// The words of a command with `{name}` replaced by the value of that name.
std::vector<std::string> filled_in(const std::vector<std::string> &command,
                                   const std::map<std::string, std::string> &values);

/// Runs a program without a shell, in a process group of its own, and waits for its end. It
/// inherits no file but an empty standard input. Throws Error naming it if it cannot be started, is
/// not done in time, is killed, or returns another status than 0, with the end of what it printed;
/// Interrupted at a stop. In each case nothing of its process group is left.
/// \param words the program and its arguments, at least one
void run_command(const std::vector<std::string> &words, Clock &clock, const CommandRun &how = {});

} // namespace tsuya::lab

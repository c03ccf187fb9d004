#pragma once
/// \file
/// What the program says while it works: progress and warnings, all on stderr.

#include <atomic>
#include <string>
#include <string_view>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {
struct Report;
}

namespace tsuya::program {

/// How progress is shown: a bar that rewrites its line, lines of text, lines of JSON, not at all.
enum class ProgressMode { bar, plain, json, off };

/// `auto` (a bar where stderr is a terminal, else off), `plain`, `json`, `off`.
ProgressMode parse_progress_mode(const std::string &name);

/// SIGINT, SIGTERM or SIGHUP end the process at once with kInterrupted, until `Console::progress`
/// is called: for commands that have nothing to save, whose files appear complete or not at all.
/// SIGHUP stays ignored where it is (nohup).
void watch_signals();

/// While it lives, any number of SIGINT, SIGTERM, SIGHUP, SIGQUIT and SIGTSTP only set the stop
/// flag of `Console::progress`: for a command that holds a lit lamp. After it, each of them ends
/// the process at once with kInterrupted. From its start on, a pipe that nobody reads ends nothing.
class SignalShield {
  public:
    SignalShield();
    ~SignalShield();
    SignalShield(const SignalShield &) = delete;
    SignalShield &operator=(const SignalShield &) = delete;
};

/// Lets SIGUSR1 set the flag that is returned, again and again.
std::atomic<bool> &watch_snapshot_signal();

/// Text of a file as a terminal may have it: control characters, which could move its cursor or
/// change its colours, become such as `\x1B`.
/// \param kept control characters that stay
std::string shown(std::string_view text, std::string_view kept = {});

class Console {
  public:
    void set_mode(ProgressMode mode) { mode_ = mode; }
    /// Progress that is shown on stderr. From now on the signals set its stop flag; a second one of
    /// its kind ends the process. The console must outlive it.
    Progress progress();

    /// Errors and warnings are escaped as by `shown`.
    void error(const Problem &problem);
    /// All problems of an error, one a line
    void errors(const Error &error);
    void error(std::string_view text);
    void warning(std::string_view text);
    void warning(const Problem &problem);
    void warnings(const Error &error);
    void warnings(const std::vector<std::string> &texts);
    /// The findings that may show in the picture.
    void warnings(const garment::Report &report, const std::string &file);
    /// Ends a line that a bar has begun.
    void end_line();

  private:
    void report(std::string_view stage, double fraction);

    ProgressMode mode_ = ProgressMode::off;
    std::string stage_{};
    int told_percent_ = -1;
    bool line_open_ = false;
};

} // namespace tsuya::program

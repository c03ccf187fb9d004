#pragma once
/// \file
/// What the commands that run a capture session share.

#include "command.h"
#include "tsuya/lab/session_run.h"

namespace tsuya::program {

/// The options of a run, and the run itself.
class SessionOptions {
  public:
    void options(Options &o);
    /// Runs the session in the folder and prints how far it is.
    /// \param plan of a new session, whose folder is made; empty: the session is there
    /// \return kDone, or kCheckFailed where frames were rejected and are missing
    Status run(const std::filesystem::path &folder, Console &console,
               const std::filesystem::path &plan = {}) const;

  private:
    lab::SessionResult result(const std::filesystem::path &folder, Console &console,
                              const std::filesystem::path &plan) const;

    bool dry_run_ = false, wait_ = false, json_ = false;
    int tries_ = 3;
    std::filesystem::path fabric_{};
};

} // namespace tsuya::program

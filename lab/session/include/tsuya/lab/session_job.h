#pragma once
/// \file
/// A session from its files to its pictures in one call: what `tsuya lab run` and `resume` do.

#include <memory>

#include "tsuya/lab/rig_mechanics.h"
#include "tsuya/lab/session_run.h"

namespace tsuya::lab {

/// Makes the camera of a dry run.
using MakeCamera = std::function<std::unique_ptr<FrameCamera>(const RigFile &rig, Clock &clock)>;

/// What is run, and with what.
struct SessionJob {
    std::filesystem::path folder{}; ///< of the session, made by create_session()
    FrameReader read{};             ///< of the pictures
    bool wait = false;              ///< for a lamp that may not be lit yet
    int tries = 3;                  ///< of a frame or a movement
    int library_threads = 0;        ///< as of Supervision
    /// As of Supervision, while something is waited for; 5 s while pictures are read and stored.
    std::chrono::milliseconds silence{200};
    /// Called with what the operator is to do; called in the calling process, must not block.
    std::function<void(const std::string &what)> ask{};
    /// Asked again and again whether the operator has done it; must not block. A session ends where
    /// the operator has not for the lamp's hold time. With neither, axes and samples that the
    /// operator moves are an error.
    std::function<bool()> answered{};
    /// The same code on simulated lines and axes in virtual time, with this camera: no hardware, no
    /// log of a lamp or of faults, nothing to wait for.
    MakeCamera simulated_camera{};
};

/// Runs a session on the rig that its plan names. Real lines are supervised: lamp and shutter go
/// off also when the work hangs or is killed, and with it the programs that it started. Throws what
/// check_same_rig_and_plan, GpioLine, run_supervised and run_session throw.
SessionResult run_session_job(const SessionJob &job, const Progress &progress = {});

} // namespace tsuya::lab

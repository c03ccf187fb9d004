#pragma once
/// \file
/// A capture session: lamp, axes, shutter and camera by a plan, with every step in a journal.

#include "tsuya/lab/frame_camera.h"
#include "tsuya/lab/lamp_log.h"
#include "tsuya/lab/mechanics.h"
#include "tsuya/lab/safety.h"
#include "tsuya/lab/session.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::lab {

/// What a session works with. All of it must outlive the run.
struct SessionHardware {
    OutputLine *lamp = nullptr;       ///< null: someone switches it by hand
    OutputLine *shutter = nullptr;    ///< null: the camera's own is the only one
    OutputLine *half_press = nullptr; ///< wakes the camera before each exposure
    InputLine *busy = nullptr;        ///< of the camera
    Mechanics &mechanics;
    FrameCamera &camera;
    SafetyClock &clock;
    FrameReader read{};
    Moments moments{};
};

/// How a session is run.
struct SessionSettings {
    std::filesystem::path lamp_log{};  ///< empty: none is kept
    std::filesystem::path fault_log{}; ///< of latched faults; empty: none is kept
    bool wait = false; ///< for a lamp that may not be lit yet, which else is an error
    int tries = 3;     ///< of a frame or a movement, > 0
};

/// How far a session is.
struct SessionResult {
    std::size_t planned = 0, counted = 0;
    /// Planned frames that do not count yet.
    std::size_t missing() const { return planned - counted; }
};

/// Makes the folder of a new session, with an empty journal and copies of the plan and of the rig
/// file and of the files that this names. Throws Error naming what is wrong: a folder that is not
/// empty or cannot be made, a rig file that is not the one of the plan, a file named by the rig
/// that lies outside of its folder. Nothing is left in the folder then.
void create_session(const std::filesystem::path &folder, const std::filesystem::path &plan,
                    const std::filesystem::path &rig);

/// Throws Error with the lines that differ if the session's rig file is not the same as `rig`, or
/// the plan, or a file that the rig file names, not the one that the session began with.
void check_same_rig_and_plan(const std::filesystem::path &folder, const std::filesystem::path &rig);

/// Takes the frames of the session's plan that do not count yet: lights the lamp, waits until it is
/// warm and three white frames a minute apart agree to 0.3 %, takes the frames, turns the lamp off.
///
/// A frame counts when its picture exists, has stopped growing, decodes, is no copy of another and
/// its exposure equals the plan's within 10 %. Recoverable faults (of camera, pictures, axes) close
/// the shutter, keep the lamp lit and are tried again; a frame that fails `tries` times is left for
/// the next run. The run ends when nothing has succeeded for the lamp's hold time. Lamp and shutter
/// are off on every way out.
///
/// Throws SessionFault: interlock or emergency stop (latched), a line that fails, a journal that
/// cannot be written, a lamp that may not be lit yet or does not become steady. Throws Error for
/// what read_session refuses and for a fault that is latched, Interrupted when `progress.stop` was
/// set. What was done by then counts.
SessionResult run_session(const std::filesystem::path &folder, const RigFile &rig,
                          const SessionHardware &hardware, const SessionSettings &settings,
                          const Progress &progress = {});

} // namespace tsuya::lab

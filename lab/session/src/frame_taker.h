#pragma once
/// \file
/// One picture: the rig moves, the shutter opens, the camera exposes, the picture is looked at.

#include <optional>

#include "frame_store.h"
#include "lamp_keeper.h"
#include "tsuya/lab/off_guard.h"
#include "tsuya/lab/rig_motion.h"
#include "tsuya/lab/session_run.h"

namespace tsuya::lab {

/// Errors are recoverable; SessionFault and Interrupted end the session.
class FrameTaker {
  public:
    FrameTaker(const RigFile &rig, const SessionHardware &hardware, FrameStore &store,
               SessionJournal &journal, const LampKeeper &lamp, const std::atomic<bool> *stop);

    /// Brings the sample and the axes to where a frame needs them.
    void go_to(const PlannedFrame &frame);
    /// Takes the picture and lets it count. The rig stands where it should.
    /// \return the mean of its patch
    double take(const Shot &shot);
    void close_shutter() { set_shutter(false); }

  private:
    void place(FrameKind kind);
    void sleep(Seconds time);
    void wait_for_camera();
    void wait_for_shutter();
    void set_shutter(bool open);
    struct Exposure {
        double begin_s, end_s; ///< seconds since 1970
    };
    Exposure expose(Shot &shot);
    /// The event from which a picture counts.
    JournalEvent count_event(const Shot &shot, const FrameFacts &facts, const std::string &hash,
                             double middle_s) const;

    const RigFile &rig_;
    const SessionHardware &hardware_;
    FrameStore &store_;
    SessionJournal &journal_;
    const LampKeeper &lamp_;
    const std::atomic<bool> *stop_;
    std::array<std::optional<double>, kAxes> at_{}; ///< where the drives stand, if that is known
    std::optional<FrameKind> sample_{};
    std::optional<std::chrono::nanoseconds> next_opening_{}; ///< not earlier
};

} // namespace tsuya::lab

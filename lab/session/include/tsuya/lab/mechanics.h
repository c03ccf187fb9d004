#pragma once
/// \file
/// What moves in a rig: its axes, and the sample under the camera.

#include "tsuya/lab/clock.h"
#include "tsuya/lab/plan.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// Moves axes and samples. Derive from it for other drives. Errors are recoverable: the movement
/// is tried again. A stop throws Interrupted.
class Mechanics {
  public:
    Mechanics() = default;
    Mechanics(const Mechanics &) = delete;
    Mechanics &operator=(const Mechanics &) = delete;
    virtual ~Mechanics() = default;

    /// Moves an axis; returns when it has arrived.
    /// \param position_deg of the drive, as positions_deg() gives it
    virtual void move(AxisName axis, double position_deg) = 0;
    /// Puts a sample under the camera; returns when it is there.
    /// \param sample cloth, white or trap
    virtual void place(FrameKind sample) = 0;
};

/// Moves nothing, but takes the times of the rig file.
class SimulatedMechanics final : public Mechanics {
  public:
    /// Both must outlive it.
    SimulatedMechanics(const RigFile &rig, Clock &clock) : rig_(rig), clock_(clock) {}
    void move(AxisName axis, double position_deg) override;
    void place(FrameKind sample) override;

  private:
    const RigFile &rig_;
    Clock &clock_;
};

} // namespace tsuya::lab

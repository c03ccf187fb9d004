#pragma once
/// \file
/// The axes and the sample of a rig file: by hand, by programs, by controllers.

#include <functional>
#include <map>
#include <memory>

#include "tsuya/lab/command_run.h"
#include "tsuya/lab/grbl.h"
#include "tsuya/lab/mechanics.h"

namespace tsuya::lab {

/// Asks the operator to do something, and returns when it is said to be done. Throws Interrupted at
/// a stop.
using AskOperator = std::function<void(const std::string &what)>;

/// Drives every axis as the rig file says.
class RigMechanics final : public Mechanics {
  public:
    /// \param how for programs; its `timeout` is not used: the rig file has one for each axis
    /// Rig and clock must outlive this.
    RigMechanics(const RigFile &rig, Clock &clock, AskOperator ask, CommandRun how);
    void move(AxisName axis, double position_deg) override;
    void place(FrameKind sample) override;

  private:
    void run(const std::vector<std::string> &words, Seconds timeout);

    const RigFile &rig_;
    Clock &clock_;
    AskOperator ask_;
    CommandRun how_;
    std::map<std::string, std::unique_ptr<GrblController>> controllers_{}; ///< by port
};

} // namespace tsuya::lab

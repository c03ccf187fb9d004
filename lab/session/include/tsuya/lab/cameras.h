#pragma once
/// \file
/// The cameras of a rig file.

#include <map>

#include "tsuya/lab/command_run.h"
#include "tsuya/lab/frame_camera.h"

namespace tsuya::lab {

/// A camera that a program drives: `[camera] command`. The program exposes, and returns when the
/// picture stands in the file.
class CommandCamera final : public FrameCamera {
  public:
    /// \param how its `timeout` is not used: the rig's, and the exposure, limit the program
    /// Camera and clock must outlive this.
    CommandCamera(const RigCamera &camera, Clock &clock, CommandRun how);
    void expose(const Shot &shot) override;
    void collect(const Shot &) override {}

  private:
    const RigCamera &camera_;
    Clock &clock_;
    CommandRun how_;
};

/// A camera that the shutter line triggers, and whose pictures arrive in `[camera] watch_folder`.
class TriggeredCamera final : public FrameCamera {
  public:
    /// \param stop may be null. All must outlive this.
    TriggeredCamera(const RigCamera &camera, Clock &clock, const std::atomic<bool> *stop);
    void expose(const Shot &shot) override;
    /// Moves the one picture that has arrived since the exposure began.
    void collect(const Shot &shot) override;

  private:
    void sleep(Seconds time);
    std::map<std::filesystem::path, std::uintmax_t> pictures() const;

    const RigCamera &camera_;
    Clock &clock_;
    const std::atomic<bool> *stop_;
    std::map<std::filesystem::path, std::uintmax_t> before_{};
};

} // namespace tsuya::lab

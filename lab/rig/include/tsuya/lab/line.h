#pragma once
/// \file
/// One wire that a program drives or watches: lamp, shutter, interlock of the measuring rig.

#include <atomic>
#include <chrono>
#include <optional>
#include <string>

namespace tsuya::lab {

/// An output line. Derive from it for another kind of hardware. A line is used from one thread at
/// a time, and is not active when it is made.
class OutputLine {
  public:
    OutputLine() = default;
    OutputLine(const OutputLine &) = delete;
    OutputLine &operator=(const OutputLine &) = delete;
    virtual ~OutputLine() = default;

    /// Drives the line. Active means "lamp on" or "shutter open", whatever level that is on the
    /// wire. Throws Error naming the line if the hardware refuses.
    virtual void set(bool active) = 0;
    /// What messages call the line.
    virtual const std::string &name() const = 0;
    /// Throws Error naming the line if it can no longer be driven, as when its device was
    /// unplugged.
    virtual void check() {}
};

/// Changes of an input line.
enum class Edge { to_active, to_inactive, any };

/// One change of an input line.
struct EdgeEvent {
    std::chrono::nanoseconds time{0}; ///< on the clock of the rig
    bool active = false;              ///< the state from then on
    bool operator==(const EdgeEvent &) const = default;
};

/// An input line, such as an interlock or a camera that says that it is busy. Derive from it for
/// another kind of hardware. A line is used from one thread at a time.
class InputLine {
  public:
    InputLine() = default;
    InputLine(const InputLine &) = delete;
    InputLine &operator=(const InputLine &) = delete;
    virtual ~InputLine() = default;

    /// The state now. Throws Error naming the line if the hardware refuses.
    virtual bool active() = 0;
    /// The earliest change of that kind that was not returned yet, also one that came before the
    /// call; changes of the other kind before it are dropped.
    /// \param deadline on the clock of the rig
    /// \param stop may be null. Once it is true the wait ends promptly.
    /// \return nothing if the deadline came or `stop` was set first
    /// Throws Error naming the line if the hardware refuses or is gone, within a second.
    virtual std::optional<EdgeEvent> wait(Edge edge, std::chrono::nanoseconds deadline,
                                          const std::atomic<bool> *stop) = 0;
    /// What messages call the line.
    virtual const std::string &name() const = 0;
};

} // namespace tsuya::lab

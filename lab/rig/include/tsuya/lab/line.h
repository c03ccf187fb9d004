#pragma once
/// \file
/// One wire that a program drives: the lamp or the shutter of the measuring rig.

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
};

} // namespace tsuya::lab

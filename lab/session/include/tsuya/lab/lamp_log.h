#pragma once
/// \file
/// The log of a lamp: strikes, hours, and when it went off, over restarts and power cuts.

#include <functional>
#include <string>

#include "tsuya/lab/journal.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// A moment on the clocks of the computer.
struct Moment {
    std::string boot{};    ///< which start of the computer
    double boottime_s = 0; ///< seconds since then, those asleep included
    double time_s = 0;     ///< seconds since 1970, which someone may set
};

/// The clock. A program without hardware has its own.
using Moments = std::function<Moment()>;

/// The moment on this computer's own clocks.
Moment moment_now();

/// What a lamp has behind it.
struct LampState {
    bool lit = false;
    int strikes = 0;
    double hours = 0;             ///< lit, until `last` where it is lit
    std::optional<Moment> last{}; ///< when it was lit or went off; none for a new lamp
};

/// How long a lamp must stay off yet. Where the computer was started again or its clock set, the
/// time of day decides; where that went back, all of `restrike` counts from now.
Seconds restrike_left(const LampState &state, Seconds restrike, const Moment &now);

/// An append-only file, one line a change, each on the disk before the call returns. Several lamps
/// may share a file.
class LampLog {
  public:
    /// \param file empty: nothing is kept
    /// \param strikes the lamp had so many at least
    /// A lamp that is lit in the file, as after a power cut, counts as gone off now. Throws what
    /// JournalWriter throws.
    LampLog(const std::filesystem::path &file, std::string serial, Moments moments,
            int strikes = 0);

    /// As the file and the changes since have it.
    const LampState &state() const { return state_; }
    /// Notes that the lamp is lit. \return its state after that
    const LampState &light();
    /// Notes that the lamp is off. \return its state after that
    const LampState &put_out();
    /// Hours that it has been lit, those since the last change included.
    double hours_now() const;

  private:
    void take(const JournalEvent &event);
    void note(bool on, const std::string &what = "");

    std::optional<JournalWriter> file_{};
    std::string serial_;
    Moments moments_;
    LampState state_{};
};

} // namespace tsuya::lab

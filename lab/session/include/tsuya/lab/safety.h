#pragma once
/// \file
/// Interlock and emergency stop: looked at before each step and watched during it, and a fault
/// that stays until someone acknowledges it.

#include <filesystem>
#include <optional>
#include <string>

#include "tsuya/lab/clock.h"
#include "tsuya/lab/line.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {

/// Ends a session: lamp off at once, whatever the work is at.
class SessionFault : public Error {
  public:
    /// \param safety the interlock or the emergency stop, which is to be acknowledged
    SessionFault(Problem problem, bool safety) : Error(std::move(problem)), safety_(safety) {}
    /// Whether it is the interlock or the emergency stop.
    bool safety() const noexcept { return safety_; }

  private:
    bool safety_;
};

/// A clock whose sleeps watch the inputs. Everything that waits in a session sleeps on it.
class SafetyClock final : public Clock {
  public:
    static constexpr std::chrono::milliseconds kLook{20}; ///< at most between two looks

    /// \param interlock active: the housing is closed. May be null
    /// \param estop active: the emergency stop is pressed. May be null
    /// All must outlive the clock.
    SafetyClock(Clock &clock, InputLine *interlock, InputLine *estop)
        : clock_(clock), interlock_(interlock), estop_(estop) {}

    std::chrono::nanoseconds now() override { return clock_.now(); }
    /// Throws SessionFault within kLook of a change that check() would tell.
    [[nodiscard]] bool sleep_until(std::chrono::nanoseconds deadline,
                                   const std::atomic<bool> *stop) override;
    void wait_more(bool begins) override { clock_.wait_more(begins); }
    /// Throws SessionFault if the housing is or was open, the stop is or was pressed since the last
    /// look, or an input cannot be read.
    void check();

  private:
    /// Whether the input is, or since the last look was, in that state.
    bool seen(InputLine &input, bool active);

    Clock &clock_;
    InputLine *interlock_, *estop_;
};

/// The fault that a rig's log of faults ends with, if nobody acknowledged it. Throws what
/// read_journal throws. \param log may be absent: no fault
std::optional<std::string> latched_fault(const std::filesystem::path &log);

/// Appends a fault to the log; it is on the disk when the call returns.
void latch_fault(const std::filesystem::path &log, const std::string &why, double time_s);

/// Ends a latched fault with the reason. Throws Error if there is none, or the reason is empty.
void acknowledge_fault(const std::filesystem::path &log, const std::string &reason, double time_s);

/// Where the faults of a rig are kept: `NAME.faults.jsonl` beside its file.
std::filesystem::path fault_log_of(const std::filesystem::path &rig_file);

} // namespace tsuya::lab

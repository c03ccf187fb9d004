#pragma once
/// \file
/// Time as the rig sees it, so that the same code runs on real hardware and in virtual time.

#include <atomic>
#include <chrono>

namespace tsuya::lab {

/// A clock that never goes back and can be slept on.
class Clock {
  public:
    Clock() = default;
    Clock(const Clock &) = delete;
    Clock &operator=(const Clock &) = delete;
    virtual ~Clock() = default;

    /// Time since the clock's own zero.
    virtual std::chrono::nanoseconds now() = 0;
    /// Sleeps until `now() >= deadline`; returns at once for a deadline in the past.
    /// \param stop may be null. Once it is true the sleep ends promptly.
    /// \return true if the deadline was reached with `stop` not set
    [[nodiscard]] virtual bool sleep_until(std::chrono::nanoseconds deadline,
                                           const std::atomic<bool> *stop) = 0;
    /// Told by Waiting that a block of it begins or ends. Most clocks need not know.
    virtual void wait_more(bool /*begins*/) {}
};

/// A block of code that does nothing but wait on a clock, in several sleeps. A supervisor of work
/// that waits notices sooner that it hangs.
class Waiting {
  public:
    /// From now until the end of the block.
    explicit Waiting(Clock &clock) : clock_(clock) { clock_.wait_more(true); }
    ~Waiting() { clock_.wait_more(false); }
    Waiting(const Waiting &) = delete;
    Waiting &operator=(const Waiting &) = delete;

  private:
    Clock &clock_;
};

/// The computer's monotonic clock; not set back or forth by the time of day. Deadlines are
/// absolute, so that lateness of one does not add to the next. A sleep notices `stop` within
/// `kStopLatency`, and at once if a signal handler that ran on the sleeping thread set it.
class SteadyClock final : public Clock {
  public:
    static constexpr std::chrono::milliseconds kStopLatency{10};

    std::chrono::nanoseconds now() override;
    [[nodiscard]] bool sleep_until(std::chrono::nanoseconds deadline,
                                   const std::atomic<bool> *stop) override;
};

} // namespace tsuya::lab

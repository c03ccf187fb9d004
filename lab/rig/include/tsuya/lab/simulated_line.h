#pragma once
/// \file
/// A rig without hardware: outputs that only remember, inputs that a program changes, and a clock
/// whose sleeps take no time.

#include "tsuya/lab/clock.h"
#include "tsuya/lab/line.h"

#include <deque>
#include <functional>
#include <map>
#include <vector>

namespace tsuya::lab {

/// Virtual time, from 0. Sleeping moves it to the deadline exactly and returns at once.
class VirtualClock final : public Clock {
  public:
    std::chrono::nanoseconds now() override { return now_; }
    [[nodiscard]] bool sleep_until(std::chrono::nanoseconds deadline,
                                   const std::atomic<bool> *stop) override;

    /// Lets time pass, as slow hardware or a busy computer would.
    /// \param duration not negative
    void advance(std::chrono::nanoseconds duration);
    /// Calls `event` when time reaches `time`: someone presses a key, a cable falls out. Events of
    /// the same time run in the order in which they were given; a time in the past runs at the next
    /// step of time.
    void at(std::chrono::nanoseconds time, std::function<void()> event);

  private:
    /// Runs the events up to `deadline` in order, until `stop` is set.
    bool pass(std::chrono::nanoseconds deadline, const std::atomic<bool> *stop);

    std::chrono::nanoseconds now_{0};
    std::multimap<std::chrono::nanoseconds, std::function<void()>> events_;
};

/// A change of a line's state.
struct Transition {
    std::chrono::nanoseconds time{0}; ///< on the line's clock
    bool active = false;              ///< the state from then on
    bool operator==(const Transition &) const = default;
};

/// A line that records when it changed. Setting the state that it already has records nothing.
class SimulatedLine final : public OutputLine {
  public:
    /// \param clock stamps the transitions; must outlive the line
    SimulatedLine(std::string name, Clock &clock) : name_(std::move(name)), clock_(clock) {}

    void set(bool active) override;
    const std::string &name() const override { return name_; }

    /// The line is on; off before the first `set`.
    bool active() const { return !transitions_.empty() && transitions_.back().active; }
    /// Every change so far, in order.
    const std::vector<Transition> &transitions() const { return transitions_; }

  private:
    std::string name_;
    Clock &clock_;
    std::vector<Transition> transitions_;
};

/// An input line whose changes are made by the program: call `change` from an event of the clock.
class SimulatedInput final : public InputLine {
  public:
    /// \param clock stamps the changes; must outlive the line
    SimulatedInput(std::string name, Clock &clock, bool active = false)
        : name_(std::move(name)), clock_(clock), active_(active) {}

    /// The outside world changes the line. The state that it already has is no change.
    void change(bool active);

    bool active() override { return active_; }
    std::optional<EdgeEvent> wait(Edge edge, std::chrono::nanoseconds deadline,
                                  const std::atomic<bool> *stop) override;
    const std::string &name() const override { return name_; }

  private:
    std::string name_;
    Clock &clock_;
    bool active_;
    std::deque<EdgeEvent> changes_;
    std::atomic<bool> changed_{false};
};

} // namespace tsuya::lab

#pragma once
/// \file
/// Lines of GPIO character devices, as on a Raspberry Pi, through libgpiod.

#include "tsuya/lab/line.h"
#include "tsuya/sdk/error.h"

#include <memory>
#include <span>
#include <vector>

namespace tsuya::lab {

/// How an output drives its wire: both levels, only the low one, or only the high one.
enum class Drive { push_pull, open_drain, open_source };

/// The resistor inside the chip; `as_is` leaves what was set.
enum class Bias { as_is, disabled, pull_up, pull_down };

/// Which line of which chip, and how.
struct GpioLineSettings {
    /// A name (`gpiochip0`), path (`/dev/gpiochip0`), label (`pinctrl-bcm2711`) or number (`0`).
    /// Empty: the chip that has a line named `line`.
    std::string chip{};
    /// The line's name; where the chip has no line of that name, its offset in decimal digits.
    std::string line{};
    bool active_low = false;        ///< active is the low level on the wire
    Drive drive = Drive::push_pull; ///< of an output
    Bias bias = Bias::as_is;
};

/// A line and what it is for.
struct NamedGpioLine {
    std::string role{}; ///< `lamp`: the place in an Error
    GpioLineSettings settings{};
};

/// Throws Error, with `where` = role, listing every line that cannot be found and every physical
/// line that is named twice, by whatever names. Takes none of them.
void check_gpio_lines(std::span<const NamedGpioLine> lines);

/// Holds a line as output for the consumer "tsuya", inactive from the start to the end: the
/// destructor drives it inactive before it lets go. Nothing can do that for a process that is
/// killed, and some kernels leave such a line driven: see run_supervised(). The line works on both
/// sides of a fork, and commands that are executed do not inherit it.
class GpioLine final : public OutputLine {
  public:
    /// Throws Error with `where` = chip or chip:line if the chip cannot be opened, no line or more
    /// than one has the name, another program holds the line, access is denied, or Tsuya was built
    /// without libgpiod.
    explicit GpioLine(const GpioLineSettings &settings);
    ~GpioLine() override;

    void set(bool active) override;
    const std::string &name() const override { return name_; }
    void check() override;

  private:
    struct Held;
    std::string name_; ///< chip:line
    std::unique_ptr<Held> held_;
};

/// Holds a line as input. Its changes are stamped by the kernel, on CLOCK_MONOTONIC as SteadyClock.
class GpioInput final : public InputLine {
  public:
    /// \param settings `drive` is not used. Throws Error as GpioLine does.
    explicit GpioInput(const GpioLineSettings &settings);
    ~GpioInput() override;

    bool active() override;
    std::optional<EdgeEvent> wait(Edge edge, std::chrono::nanoseconds deadline,
                                  const std::atomic<bool> *stop) override;
    const std::string &name() const override { return name_; }

  private:
    struct Held;
    std::string name_; ///< chip:line
    std::unique_ptr<Held> held_;
};

/// A line that could be asked for.
struct GpioLineInfo {
    std::string chip{};     ///< `gpiochip0`
    std::string label{};    ///< of the chip
    unsigned offset = 0;    ///< on the chip
    std::string name{};     ///< empty where the line has none
    std::string consumer{}; ///< who holds it; empty where it is free
    bool output = false;    ///< its direction now
};

/// What this user can see of a computer's GPIO.
struct GpioListing {
    std::vector<GpioLineInfo> lines{}; ///< by chip and offset
    std::vector<Problem> unreadable{}; ///< one for each chip that cannot be opened
};

/// Every line of every chip; nothing on a computer without GPIO. Throws Error if Tsuya was built
/// without libgpiod.
GpioListing gpio_lines();

} // namespace tsuya::lab

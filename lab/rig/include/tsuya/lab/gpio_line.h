#pragma once
/// \file
/// A line of a GPIO character device, as on a Raspberry Pi, through libgpiod.

#include "tsuya/lab/line.h"

#include <memory>
#include <vector>

namespace tsuya::lab {

/// Which line of which chip.
struct GpioLineSettings {
    /// A name (`gpiochip0`), path, label or number. Empty: the chip that has a line named `line`.
    std::string chip{};
    /// The line's name; where the chip has no line of that name, its offset in decimal digits.
    std::string line{};
    bool active_low = false; ///< active is the low level on the wire
};

/// Holds a line as output for the consumer "tsuya", inactive from the start to the end: the
/// destructor drives it inactive before it lets go. Nothing can do that for a process that is
/// killed, and some kernels leave such a line driven, so a rig also needs a resistor or a relay
/// that falls back to off.
class GpioLine final : public OutputLine {
  public:
    /// Throws Error with `where` = chip or chip:line if the chip cannot be opened, no line or more
    /// than one chip has the name, another program holds the line, or access is denied.
    explicit GpioLine(const GpioLineSettings &settings);
    ~GpioLine() override;

    void set(bool active) override;
    const std::string &name() const override { return name_; }

  private:
    struct Held;
    std::string name_; ///< chip:line
    std::unique_ptr<Held> held_;
};

/// A line that could be asked for.
struct GpioLineInfo {
    std::string chip{};     ///< `gpiochip0`
    unsigned offset = 0;    ///< on the chip
    std::string name{};     ///< empty where the line has none
    std::string consumer{}; ///< who holds it; empty where it is free
};

/// Every line of every chip that this user may open, by chip and offset; empty on a computer
/// without GPIO. Chips that cannot be opened are left out.
std::vector<GpioLineInfo> gpio_lines();

} // namespace tsuya::lab

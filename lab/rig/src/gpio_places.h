#pragma once
/// \file
/// From names of chips and lines to places.

#include "tsuya/lab/gpio_line.h"

#include <string>
#include <system_error>
#include <vector>

namespace tsuya::lab {

/// A line of a chip that exists.
struct GpioPlace {
    std::string path{}; ///< of the chip's device, without symbolic links
    std::string chip{}; ///< `gpiochip0`
    unsigned offset = 0;
    std::string consumer{}; ///< who holds it; empty where it is free
};

/// Paths of the chips of this computer in order, also of those that cannot be opened.
std::vector<std::string> gpio_chip_paths();

/// Throws Error as GpioLine's constructor does.
GpioPlace find_gpio_line(const GpioLineSettings &settings);

/// An Error that says what to do about the system's answer.
Error gpio_error(const std::string &what, const std::string &where, const std::system_error &error,
                 const std::string &consumer = "");

} // namespace tsuya::lab

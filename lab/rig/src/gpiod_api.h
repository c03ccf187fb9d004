#pragma once
/// \file
/// The seam to libgpiod: what gpio_line.cpp needs of whichever version is there. Failures of the
/// system are std::system_error.

#include <memory>
#include <string>
#include <vector>

namespace tsuya::lab::gpiod_api {

/// A line as the kernel tells of it.
struct LineInfo {
    std::string name{};
    std::string consumer{};
};

/// A line held as output.
class Request {
  public:
    virtual ~Request() = default;
    virtual void set(bool active) = 0;
};

/// Names of the chips of this computer in order (`gpiochip0`), also of those that cannot be opened.
std::vector<std::string> chips();
/// The lines of a chip by offset.
/// \param chip name, path, label or number
std::vector<LineInfo> lines(const std::string &chip);
/// Holds the line as output, inactive.
std::unique_ptr<Request> request(const std::string &chip, unsigned offset, bool active_low,
                                 const std::string &consumer);

} // namespace tsuya::lab::gpiod_api

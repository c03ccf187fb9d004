#pragma once
/// \file
/// The seam to libgpiod: what the rig needs of whichever version is there. Failures of the system
/// are std::system_error.

#include "tsuya/lab/gpio_line.h"

#include <memory>
#include <string>
#include <vector>

namespace tsuya::lab::gpiod_api {

/// A line as the kernel reports it.
struct LineInfo {
    std::string name{};
    std::string consumer{};
    bool output = false;
};

/// A chip as the kernel reports it; the lines by offset.
struct ChipInfo {
    std::string label{};
    std::vector<LineInfo> lines{};
};

/// A line held, as output or as input.
class Request {
  public:
    virtual ~Request() = default;
    virtual void set(bool active) = 0;
    virtual bool get() = 0;
    /// A descriptor that can be read when there is an edge; inputs only.
    virtual int descriptor() = 0;
    /// The next edge; blocks where there is none. Inputs only.
    virtual EdgeEvent read_edge() = 0;
};

/// Where and how a line is held.
struct RequestSettings {
    std::string path{}; ///< of the chip
    unsigned offset = 0;
    bool output = false; ///< held inactive; an input reports both edges
    bool active_low = false;
    Drive drive = Drive::push_pull;
    Bias bias = Bias::as_is;
};

/// Throws Error in a build without libgpiod.
void need_library();
ChipInfo chip_info(const std::string &path);
std::unique_ptr<Request> request(const RequestSettings &settings, const std::string &consumer);

} // namespace tsuya::lab::gpiod_api

#pragma once
/// \file
/// Axes on a controller that speaks GRBL 1.1, at a serial port with 115200 baud.

#include <atomic>
#include <set>
#include <string>

#include "tsuya/lab/clock.h"
#include "tsuya/lab/rig_file.h"

namespace tsuya::lab {

/// What a controller says about itself.
struct GrblStatus {
    std::string state{};              ///< `Idle`, `Run`, `Alarm`...
    std::array<double, 6> position{}; ///< of the axes X Y Z A B C, in the units of the machine
    std::size_t axes = 0;             ///< how many it reports
};

/// Takes `<Idle|MPos:1.000,0.000,0.000|FS:0,0>` apart; false if it is no such line.
bool parse_grbl_status(const std::string &line, GrblStatus &status);

/// One controller. Homes before the first movement and after each alarm. An `ok` means only that a
/// line was accepted: an axis has arrived when two reports say Idle at the asked position.
class GrblController {
  public:
    /// Opens the port. Throws Error naming it.
    /// \param stop may be null; it and the clock must outlive this
    GrblController(std::string port, Clock &clock, const std::atomic<bool> *stop);
    ~GrblController();
    GrblController(const GrblController &) = delete;
    GrblController &operator=(const GrblController &) = delete;

    /// Moves one axis. Throws Error naming the port: no answer within the axis's timeout, an error
    /// or an alarm of the controller, after which the next movement homes first. Throws Interrupted
    /// at a stop, with the controller told to hold.
    void move(const RigAxis &axis, double position_deg);

  private:
    void home(std::chrono::nanoseconds deadline);
    void send(const std::string &text);
    void command(const std::string &line, std::chrono::nanoseconds deadline);
    std::string read_line(std::chrono::nanoseconds deadline);
    GrblStatus status();
    void wait_for_arrival(const RigAxis &axis, double position_deg,
                          std::chrono::nanoseconds deadline);
    void sleep();
    [[noreturn]] void fail(const std::string &what);

    std::string port_;
    Clock &clock_;
    const std::atomic<bool> *stop_;
    int descriptor_ = -1;
    bool homed_ = false;
    std::string buffer_{};
};

} // namespace tsuya::lab

#pragma once
// A GRBL 1.1 controller that exists only as a thread at a pseudo terminal.

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace tsuya::test {

/// Greets, homes, accepts a movement at once and reports Run until it has arrived. Its axes take
/// `kMove` for any way.
class GrblStandIn {
  public:
    static constexpr std::chrono::milliseconds kMove{400};

    GrblStandIn() : master_(posix_openpt(O_RDWR | O_NOCTTY)) {
        grantpt(master_);
        unlockpt(master_);
        port_ = ptsname(master_);
        termios raw{};
        tcgetattr(master_, &raw);
        cfmakeraw(&raw);
        tcsetattr(master_, TCSANOW, &raw);
        held_ = open(port_.c_str(), O_RDWR | O_NOCTTY); // a terminal that nobody holds hangs up
        say("\r\nGrbl 1.1h ['$' for help]\r\n");
        thread_ = std::thread([this] { serve(); });
    }
    ~GrblStandIn() {
        ending_ = true;
        thread_.join();
        close(held_);
        close(master_);
    }
    GrblStandIn(const GrblStandIn &) = delete;
    GrblStandIn &operator=(const GrblStandIn &) = delete;

    const std::string &port() const { return port_; }

    std::atomic<bool> silent{false};     ///< answers nothing
    std::atomic<bool> half_lines{false}; ///< sends each line in two parts
    std::atomic<int> alarms_at_move{0};  ///< so many movements end in an alarm
    std::atomic<double> short_by{0};     ///< stands so far from where it should
    std::atomic<int> homings{0}, moves{0}, holds{0};

  private:
    using Time = std::chrono::steady_clock::time_point;

    void say(const std::string &text) {
        if (silent)
            return;
        const std::size_t half = half_lines ? text.size() / 2 : text.size();
        for (const std::string &part : {text.substr(0, half), text.substr(half)}) {
            [[maybe_unused]] const ssize_t wrote = write(master_, part.data(), part.size());
            if (half_lines)
                std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
    }
    void serve() {
        std::string line;
        while (!ending_) {
            pollfd ready{.fd = master_, .events = POLLIN, .revents = 0};
            char byte = 0;
            if (poll(&ready, 1, 5) <= 0 || read(master_, &byte, 1) != 1)
                continue;
            if (byte == '?')
                report();
            else if (byte == '!')
                ++holds;
            else if (byte != '\n')
                line += byte;
            else
                take(std::exchange(line, ""));
        }
    }
    void report() {
        char text[120];
        const bool runs = std::chrono::steady_clock::now() < arrives_;
        std::snprintf(text, sizeof text, "<%s|MPos:%.3f,%.3f,%.3f|FS:0,0>\r\n",
                      alarm_ ? "Alarm" : (runs ? "Run" : "Idle"), at_[0] - short_by, at_[1],
                      at_[2]);
        say(text);
    }
    void take(const std::string &line) {
        if (line == "$H") {
            ++homings;
            alarm_ = false;
            at_ = {};
            say("ok\r\n");
        } else if (alarm_) {
            say("error:9\r\n");
        } else if (line.starts_with("G90 G1 ")) {
            ++moves;
            if (alarms_at_move > 0) {
                --alarms_at_move;
                alarm_ = true;
                say("ALARM:1\r\n");
                return;
            }
            at_[static_cast<std::size_t>(line[7] - 'X')] = std::strtod(line.c_str() + 8, nullptr);
            arrives_ = std::chrono::steady_clock::now() + kMove;
            say("ok\r\n"); // at once: accepted, not arrived
        } else {
            say("error:20\r\n");
        }
    }

    int master_, held_ = -1;
    std::string port_;
    std::array<double, 3> at_{};
    Time arrives_{};
    bool alarm_ = false;
    std::atomic<bool> ending_{false};
    std::thread thread_{};
};

} // namespace tsuya::test

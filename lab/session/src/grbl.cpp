#include "tsuya/lab/grbl.h"

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

constexpr std::chrono::milliseconds kLook{20}; // at the port
constexpr std::chrono::milliseconds kAsk{100}; // from one status report to the next
constexpr std::chrono::seconds kAnswer{2};     // a report comes in that time
constexpr std::chrono::seconds kStart{2};      // a controller that was opened greets in that time
constexpr const char *kLetters = "XYZABC";

void set_up_port(int descriptor) {
    termios settings{};
    if (tcgetattr(descriptor, &settings) != 0)
        return; // not every port has them
    cfmakeraw(&settings);
    cfsetispeed(&settings, B115200);
    cfsetospeed(&settings, B115200);
    settings.c_cflag |= CLOCAL | CREAD;
    tcsetattr(descriptor, TCSANOW, &settings);
}

} // namespace

bool parse_grbl_status(const std::string &line, GrblStatus &status) {
    if (line.size() < 2 || line.front() != '<' || line.back() != '>')
        return false;
    std::istringstream fields(line.substr(1, line.size() - 2));
    std::getline(fields, status.state, '|');
    status.state = status.state.substr(0, status.state.find(':')); // Hold:0
    status.axes = 0;
    for (std::string field; std::getline(fields, field, '|');) {
        if (!field.starts_with("MPos:"))
            continue;
        std::istringstream numbers(field.substr(5));
        for (std::string number;
             status.axes < status.position.size() && std::getline(numbers, number, ',');)
            status.position[status.axes++] = std::strtod(number.c_str(), nullptr);
    }
    return status.axes > 0;
}

GrblController::GrblController(std::string port, Clock &clock, const std::atomic<bool> *stop)
    : port_(std::move(port)), clock_(clock), stop_(stop) {
    descriptor_ = open(port_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (descriptor_ < 0)
        throw Error({std::string("the port cannot be opened: ") + std::strerror(errno), port_,
                     "expected a GRBL controller"});
    set_up_port(descriptor_);
}

GrblController::~GrblController() { close(descriptor_); }

void GrblController::fail(const std::string &what) {
    homed_ = false; // where the axes stand is no longer certain
    buffer_.clear();
    throw Error({what, port_, "expected a GRBL controller that answers"});
}

void GrblController::sleep() {
    if (clock_.sleep_until(clock_.now() + kLook, stop_))
        return;
    send("!"); // feed hold
    homed_ = false;
    throw Interrupted("stopped while an axis moved");
}

void GrblController::send(const std::string &text) {
    if (write(descriptor_, text.data(), text.size()) != static_cast<ssize_t>(text.size()))
        fail(std::string("the controller takes no command: ") + std::strerror(errno));
}

std::string GrblController::read_line(nanoseconds deadline) {
    for (;;) {
        if (const std::size_t end = buffer_.find('\n'); end != std::string::npos) {
            std::string line = buffer_.substr(0, end);
            buffer_.erase(0, end + 1);
            while (!line.empty() && line.back() == '\r')
                line.pop_back();
            if (line.starts_with("ALARM"))
                fail("the controller says " + line);
            return line;
        }
        char part[256];
        const ssize_t got = read(descriptor_, part, sizeof part);
        if (got > 0)
            buffer_.append(part, static_cast<std::size_t>(got));
        else if (got < 0 && errno != EAGAIN && errno != EINTR)
            fail(std::string("the port cannot be read: ") + std::strerror(errno));
        else if (clock_.now() >= deadline)
            fail("no answer in time");
        else
            sleep();
    }
}

void GrblController::command(const std::string &line, nanoseconds deadline) {
    send(line + "\n");
    for (;;) {
        const std::string answer = read_line(deadline);
        if (answer == "ok")
            return;
        if (answer.starts_with("error"))
            fail("the controller says " + answer + " to " + line);
    }
}

GrblStatus GrblController::status() {
    const nanoseconds deadline = clock_.now() + kAnswer;
    send("?");
    for (;;) {
        GrblStatus status;
        if (!parse_grbl_status(read_line(deadline), status))
            continue; // an ok or a message that came in between
        if (status.state == "Alarm")
            fail("the controller is in alarm");
        return status;
    }
}

/// The greeting of a controller that started again with the opening of the port is read over.
void GrblController::home(nanoseconds deadline) {
    const nanoseconds ready = std::min<nanoseconds>(deadline, clock_.now() + kStart);
    while (clock_.now() < ready && buffer_.find("Grbl") == std::string::npos) {
        char part[256];
        if (const ssize_t got = read(descriptor_, part, sizeof part); got > 0)
            buffer_.append(part, static_cast<std::size_t>(got));
        else
            sleep();
    }
    buffer_.clear();
    command("$H", deadline);
    homed_ = true;
}

void GrblController::wait_for_arrival(const RigAxis &axis, double position_deg,
                                      nanoseconds deadline) {
    const std::size_t index = std::string(kLetters).find(axis.letter);
    for (int idle = 0; idle < 2;) {
        const GrblStatus now = status();
        if (index >= now.axes)
            fail(std::string("the controller has no axis ") + axis.letter);
        const bool there = now.state == "Idle" &&
                           std::abs(now.position[index] - position_deg) <= axis.tolerance_deg;
        idle = there ? idle + 1 : 0;
        if (clock_.now() >= deadline)
            fail("the axis " + std::string(1, axis.letter) + " stands at " +
                 std::to_string(now.position[index]) + " and not at " +
                 std::to_string(position_deg) + " degrees");
        for (const nanoseconds next = clock_.now() + kAsk; idle < 2 && clock_.now() < next;)
            sleep();
    }
}

void GrblController::move(const RigAxis &axis, double position_deg) {
    const nanoseconds deadline = clock_.now() + std::chrono::round<nanoseconds>(axis.timeout);
    if (!homed_)
        home(deadline);
    char line[80];
    std::snprintf(line, sizeof line, "G90 G1 %c%.4f F%.0f", axis.letter, position_deg,
                  axis.feed_deg_per_min);
    command(line, deadline);
    wait_for_arrival(axis, position_deg, deadline);
}

} // namespace tsuya::lab

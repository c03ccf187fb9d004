#include "tsuya/lab/supervisor.h"

#include "tsuya/lab/off_guard.h"
#include "tsuya/sdk/error.h"
#include "worker.h"
#include "worker_pipes.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <system_error>

#include <sys/wait.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

using detail::Frame;
using detail::FrameKind;
using detail::WorkerPipes;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kLook{10};       // at the stop flag and at the silence
constexpr milliseconds kCheckEach{500}; // whether the lines are still there
constexpr milliseconds kKillWait{5000}; // for a killed child to be gone
constexpr milliseconds kMinSilence{100};
constexpr milliseconds kMaxSilence{5000};

/// The calling process's side.
class Supervisor {
  public:
    Supervisor(const Supervision &supervision, const Progress &progress, WorkerPipes &pipes,
               pid_t child)
        : supervision_(supervision), progress_(progress), pipes_(pipes), child_(child) {}

    /// Until the work ended, hung, or must be ended.
    void watch();
    /// Nothing of the work is left, and the lines are off. \return what may still be on
    std::vector<Problem> end();
    /// Throws unless the work returned.
    void throw_outcome(const std::vector<Problem> &still_on);

  private:
    void look_at_stop();
    void look_at_lines();
    void take(const Frame &frame);
    /// How long the work may be silent in what it does now.
    milliseconds patience() const {
        return waits_ ? supervision_.silence
                      : std::max(supervision_.silence, supervision_.silence_at_work);
    }
    std::vector<Problem> drive_off() const { return OffGuard(supervision_.lines).drive_off(); }
    void wait_for_child();

    const Supervision &supervision_;
    const Progress &progress_;
    WorkerPipes &pipes_;
    pid_t child_;
    int command_ = 0; ///< process group of what the work runs
    SteadyClock clock_{};
    nanoseconds last_beat_{clock_.now()};
    nanoseconds last_check_{last_beat_};
    nanoseconds stopped_at_{0};
    bool waits_ = false; ///< on its clock
    bool stopping_ = false, ended_ = false, returned_ = false, pulse_ = false;
    std::vector<Problem> problems_{};
    std::string interrupted_{};
    int status_ = 0;
    bool gone_ = false;
};

void Supervisor::watch() {
    while (!ended_) {
        const bool open = pipes_.wait_and_read(static_cast<int>(kLook.count()));
        for (Frame frame; !ended_ && pipes_.next(frame);)
            take(frame);
        if (ended_ || !open)
            return;
        look_at_stop();
        look_at_lines();
        if (const nanoseconds silent = clock_.now() - last_beat_;
            !stopping_ && silent > patience()) {
            problems_.push_back({.what = "the work hung: nothing was heard of it for " +
                                         std::to_string(silent / milliseconds(1)) +
                                         " ms; it was killed",
                                 .where = "supervisor",
                                 .accepted = "work that beats, or a longer silence"});
            return;
        }
    }
}

void Supervisor::take(const Frame &frame) {
    last_beat_ = clock_.now();
    switch (frame.kind) {
    case FrameKind::beat:
        if (supervision_.heartbeat)
            supervision_.heartbeat->set(pulse_ = !pulse_);
        break;
    case FrameKind::waits:
        waits_ = frame.payload == std::string_view("\1");
        break;
    case FrameKind::progress: {
        double fraction = 0;
        std::memcpy(&fraction, frame.payload.data(), sizeof fraction);
        progress_(std::string_view(frame.payload).substr(sizeof fraction), fraction);
        break;
    }
    case FrameKind::message:
        if (supervision_.receive && !stopping_) // after a stop the lines are off under the work
            supervision_.receive(frame.payload);
        break;
    case FrameKind::group:
        std::memcpy(&command_, frame.payload.data(), sizeof command_);
        break;
    case FrameKind::problem: {
        const std::size_t where = frame.payload.find('\0') + 1;
        const std::size_t accepted = frame.payload.find('\0', where) + 1;
        problems_.push_back({.what = frame.payload.c_str(),
                             .where = frame.payload.c_str() + where,
                             .accepted = frame.payload.c_str() + accepted});
        break;
    }
    case FrameKind::interrupted:
        interrupted_ = frame.payload;
        ended_ = true;
        break;
    case FrameKind::done:
        returned_ = true;
        ended_ = true;
        break;
    case FrameKind::failed:
        ended_ = true;
        break;
    }
}

/// A stop drives off first. The work may then end by itself, and cannot light the lamp again.
void Supervisor::look_at_stop() {
    if (!progress_.stopped())
        return;
    drive_off();
    if (!stopping_) {
        stopping_ = true;
        stopped_at_ = clock_.now();
        pipes_.ask_to_stop();
    }
    ended_ = clock_.now() - stopped_at_ > kStopGrace;
}

void Supervisor::look_at_lines() {
    if (clock_.now() - last_check_ < kCheckEach)
        return;
    last_check_ = clock_.now();
    for (OutputLine *line : supervision_.lines) {
        try {
            if (line)
                line->check();
        } catch (const Error &error) {
            problems_.insert(problems_.end(), error.problems().begin(), error.problems().end());
            ended_ = true;
        }
    }
}

void Supervisor::wait_for_child() {
    const nanoseconds patience = clock_.now() + kKillWait;
    while (!(gone_ = waitpid(child_, &status_, WNOHANG) == child_) && clock_.now() < patience)
        static_cast<void>(clock_.sleep_until(clock_.now() + milliseconds(1), nullptr));
}

std::vector<Problem> Supervisor::end() {
    drive_off();
    // One that ended by itself and was not waited for still has its number, so this kills no other.
    kill(-child_, SIGKILL);
    kill(child_, SIGKILL);
    if (command_ > 0)
        kill(-command_, SIGKILL);
    wait_for_child();
    std::vector<Problem> still_on = drive_off(); // the child could have set them in between
    if (supervision_.heartbeat) {
        const std::vector<Problem> more = OffGuard({supervision_.heartbeat}).drive_off();
        still_on.insert(still_on.end(), more.begin(), more.end());
    }
    if (!gone_)
        still_on.push_back({.what = "the work could not be killed",
                            .where = "process " + std::to_string(child_),
                            .accepted = "switch the lamp off by hand"});
    return still_on;
}

void Supervisor::throw_outcome(const std::vector<Problem> &still_on) {
    if (returned_ && still_on.empty())
        return;
    if (still_on.empty() && problems_.empty() && (stopping_ || !interrupted_.empty()))
        throw Interrupted(interrupted_.empty() ? "stopped; the lines are off" : interrupted_);
    if (!returned_ && problems_.empty() && interrupted_.empty() && !stopping_)
        problems_.push_back({.what = WIFSIGNALED(status_)
                                         ? "the work was killed by signal " +
                                               std::to_string(WTERMSIG(status_)) + " (" +
                                               strsignal(WTERMSIG(status_)) + ")"
                                         : "the work ended without saying how",
                             .where = "supervisor",
                             .accepted = "work that returns or throws"});
    problems_.insert(problems_.end(), still_on.begin(), still_on.end());
    throw Error(std::move(problems_));
}

} // namespace

int other_threads() {
    std::error_code unknown;
    const auto threads =
        std::distance(std::filesystem::directory_iterator("/proc/self/task", unknown), {});
    return unknown ? 0 : static_cast<int>(threads) - 1;
}

namespace {

void check_supervision(const Supervision &supervision) {
    Problems problems;
    problems.need(supervision.silence >= kMinSilence && supervision.silence <= kMaxSilence,
                  "is " + std::to_string(supervision.silence.count()) + " ms", "silence",
                  "100 ms to 5 s");
    problems.need(supervision.silence_at_work == milliseconds(0) ||
                      (supervision.silence_at_work >= supervision.silence &&
                       supervision.silence_at_work <= kMaxSilence),
                  "is " + std::to_string(supervision.silence_at_work.count()) + " ms",
                  "silence_at_work", "0, or from `silence` to 5 s");
    const int threads = other_threads();
    problems.need(threads <= supervision.library_threads,
                  "the program has " + std::to_string(threads + 1) + " threads", "supervisor",
                  "a call before other threads start: a fork copies one thread only");
    problems.throw_if_any();
}

} // namespace

void run_supervised(const Supervision &supervision, const std::function<void(Worker &)> &work,
                    const Progress &progress) {
    check_supervision(supervision);
    WorkerPipes pipes;
    const pid_t child = fork();
    if (child < 0)
        throw Error({.what = "no process can be made: " + std::generic_category().message(errno),
                     .where = "supervisor"});
    if (child == 0)
        detail::be_worker(pipes, work);
    setpgid(child, child); // whichever of the two is first
    pipes.become_supervisor();
    Supervisor supervisor(supervision, progress, pipes, child);
    std::exception_ptr callers_own;
    try {
        supervisor.watch();
    } catch (...) { // of progress, receive or the heartbeat line
        callers_own = std::current_exception();
    }
    const std::vector<Problem> still_on = supervisor.end();
    if (callers_own && still_on.empty())
        std::rethrow_exception(callers_own);
    supervisor.throw_outcome(still_on);
}

} // namespace tsuya::lab

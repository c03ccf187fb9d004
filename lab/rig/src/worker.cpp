#include "worker.h"

#include "tsuya/sdk/error.h"
#include "worker_pipes.h"

#include <algorithm>
#include <csignal>
#include <cstring>

#include <unistd.h>

namespace tsuya::lab {

using detail::FrameKind;
using detail::WorkerPipes;

Worker::Worker(WorkerPipes &pipes) : pipes_(pipes) {}

void Worker::beat() {
    if (pipes_.stop_asked())
        stop_ = true;
    // Work of many short sleeps does not keep the supervisor awake.
    if (const auto now = clock_.now(); now - last_beat_ >= kBeat / 4) {
        pipes_.write(FrameKind::beat, {}, true);
        last_beat_ = now;
    }
}

void Worker::send(std::string_view message) {
    if (message.size() > kMaxMessage)
        throw Error({.what = "a message of " + std::to_string(message.size()) + " bytes",
                     .accepted = "at most " + std::to_string(kMaxMessage)});
    pipes_.write(FrameKind::message, message, false);
}

void Worker::command_group(int group) {
    pipes_.write(FrameKind::group, {reinterpret_cast<const char *>(&group), sizeof group}, false);
}

Progress Worker::progress() {
    return {.report =
                [this](std::string_view stage, double fraction) {
                    std::string payload(sizeof fraction, '\0');
                    std::memcpy(payload.data(), &fraction, sizeof fraction);
                    pipes_.write(FrameKind::progress, payload.append(stage), true);
                },
            .stop = &stop_};
}

bool Worker::BeatingClock::sleep_until(std::chrono::nanoseconds deadline,
                                       const std::atomic<bool> *stop) {
    const Waiting waiting(*this);
    for (;;) {
        worker_.beat();
        const auto wake = std::min<std::chrono::nanoseconds>(deadline, now() + kBeat / 2);
        if (!steady_.sleep_until(wake, stop))
            return false;
        if (wake == deadline)
            return true;
    }
}

void Worker::BeatingClock::wait_more(bool begins) {
    const int before = waits_;
    waits_ += begins ? 1 : -1;
    if ((before > 0) != (waits_ > 0))
        worker_.pipes_.write(FrameKind::waits, {begins ? "\1" : "\0", 1}, false);
}

namespace detail {
namespace {

constexpr std::size_t kMaxText = WorkerPipes::kMaxPayload / 3 - 1;

void tell(WorkerPipes &pipes, const Problem &problem) {
    std::string payload;
    for (const std::string *text : {&problem.what, &problem.where, &problem.accepted})
        payload.append(text->substr(0, kMaxText)).push_back('\0');
    pipes.write(FrameKind::problem, payload, false);
}

} // namespace

void be_worker(WorkerPipes &pipes, const std::function<void(Worker &)> &work) {
    setpgid(0, 0);
    // The caller's handlers belong to the caller; the terminal's signals reach it alone.
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGTSTP})
        std::signal(signal, SIG_DFL);
    std::signal(SIGPIPE, SIG_IGN);
    pipes.become_worker();
    Worker worker(pipes);
    try {
        worker.beat();
        work(worker);
        pipes.write(FrameKind::done, {}, false);
    } catch (const Error &error) {
        for (const Problem &problem : error.problems())
            tell(pipes, problem);
        pipes.write(FrameKind::failed, {}, false);
    } catch (const Interrupted &interrupted) {
        pipes.write(FrameKind::interrupted, interrupted.what(), false);
    } catch (const std::exception &error) {
        tell(pipes, {.what = error.what()});
        pipes.write(FrameKind::failed, {}, false);
    } catch (...) {
        tell(pipes, {.what = "unknown error"});
        pipes.write(FrameKind::failed, {}, false);
    }
    _exit(0);
}

} // namespace detail
} // namespace tsuya::lab

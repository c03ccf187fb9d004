// What tsuya lab run and tsuya lab resume share.

#include "lab_session.h"

#include <iostream>
#include <numeric>

#include <poll.h>
#include <unistd.h>

#include "json.h"
#include "tsuya/color/camera_frame.h"
#include "tsuya/lab/progress_relay.h"
#include "tsuya/lab/session_job.h"
#include "tsuya/lab/supervisor.h"

namespace tsuya::program {
namespace {

/// Whether the operator has pressed Enter since the last call.
bool enter_was_pressed() {
    if (isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) != getpgrp())
        return false; // in the background: reading would stop the program
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (poll(&input, 1, 0) <= 0)
        return false;
    char text[256];
    if (read(STDIN_FILENO, text, sizeof text) > 0)
        return true;
    throw Error({"nobody is there to answer", "standard input", "expected a terminal"});
}

/// A terminal that takes nothing now is not waited for: the lamp is lit.
void ask(const std::string &what) {
    const std::string line = "\ntsuya: please " + what + ", then press Enter\n";
    pollfd terminal{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
    const bool takes = poll(&terminal, 1, 0) > 0 && (terminal.revents & POLLOUT) != 0;
    [[maybe_unused]] const ssize_t told =
        takes ? write(STDERR_FILENO, line.data(), line.size()) : 0;
}

/// What a picture says, with the mean of the patch in its middle.
lab::FrameFacts facts_of(const std::filesystem::path &file, const lab::RigCamera &camera) {
    const CameraFrame frame = read_frame(file);
    const int side = camera.patch;
    if (frame.width < side || frame.height < side)
        throw Error({"the picture is smaller than the patch", file.string(),
                     "expected " + std::to_string(side) + " pixels along each side"});
    double sum = 0;
    const std::size_t count = static_cast<std::size_t>(side) * frame.image.channels.size();
    for (int y = 0; y < side; ++y) {
        const float *const row =
            frame.image.pixel((frame.width - side) / 2, (frame.height - side) / 2 + y);
        sum = std::accumulate(row, row + count, sum);
    }
    return {.exposure_s = frame.exposure_s,
            .patch_mean = sum / (static_cast<double>(count) * side) - camera.black};
}

} // namespace

void SessionOptions::options(Options &o) {
    o.flag("--wait", &wait_, "wait for a lamp that may not be lit yet; without it, an error");
    o.option("--tries", &tries_, "N", "tries of a frame or a movement").range(1, 100);
    o.flag("--json", &json_, "print the report as JSON");
}

/// The lines are let go before anything waits for a terminal that does not take the progress.
lab::SessionResult SessionOptions::result(const std::filesystem::path &folder,
                                          Console &console) const {
    const lab::SessionJob job{.folder = folder,
                              .read = facts_of,
                              .wait = wait_,
                              .tries = tries_,
                              .library_threads = lab::other_threads(), // none is our own yet
                              .ask = ask,
                              .answered = enter_was_pressed};
    lab::ProgressRelay relay(console.progress());
    const SignalShield shield;
    return lab::run_session_job(job, relay.progress());
}

Status SessionOptions::run(const std::filesystem::path &folder, Console &console) const {
    const lab::SessionResult done = result(folder, console);
    if (json_)
        std::cout << Json{{"schema", "tsuya-lab-run 1"},
                          {"planned", done.planned},
                          {"counted", done.counted},
                          {"missing", done.missing()}}
                         .text()
                  << "\n";
    else
        std::cout << done.counted << " of " << done.planned << " frames\n"
                  << folder.string() << "\n";
    return done.missing() == 0 ? kDone : kCheckFailed;
}

} // namespace tsuya::program

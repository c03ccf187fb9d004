// What tsuya lab run and tsuya lab resume share.

#include "lab_session.h"

#include <iostream>

#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include "json.h"
#include "tsuya/lab/frame_reader.h"
#include "tsuya/lab/progress_relay.h"
#include "tsuya/lab/session_job.h"
#include "tsuya/lab/supervisor.h"
#include "tsuya/lab/virtual_camera.h"
#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/fabric.h"

namespace tsuya::program {
namespace {

constexpr double kGrey = 0.02; // 1/sr, of a cloth that nobody has named

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

/// The operator at the terminal. A terminal that takes nothing now is not waited for, since the
/// lamp is lit: the question comes as soon as it does.
class Operator {
  public:
    void ask(const std::string &what) {
        untold_ = "\ntsuya: please " + what + ", then press Enter\n";
        tell();
    }
    bool answered() {
        tell();
        return untold_.empty() && enter_was_pressed();
    }

  private:
    void tell() {
        pollfd terminal{.fd = STDERR_FILENO, .events = POLLOUT, .revents = 0};
        if (untold_.empty() || poll(&terminal, 1, 0) <= 0)
            return;
        // What was typed before the question is no answer to it. Does nothing without a terminal.
        tcflush(STDIN_FILENO, TCIFLUSH);
        const ssize_t told = write(STDERR_FILENO, untold_.data(), untold_.size());
        untold_.erase(0, told < 0 ? std::string::npos : static_cast<std::size_t>(told));
    }

    std::string untold_{};
};

/// What the surface of a fabric reflects; its body is left out, as in a black cloth.
std::function<double(const DirectionPair &)> reflectance_of(const std::filesystem::path &fabric) {
    if (fabric.empty())
        return [](const DirectionPair &) { return kGrey; };
    const Material material = resolve(read_fabric(fabric), fabric.string());
    if (!material.specular)
        throw Error({"the fabric has no specular part", fabric.string(), "expected a cloth"});
    return [brdf = *material.specular](const DirectionPair &pair) {
        return static_cast<double>(
            brdf.evaluate(glm::vec3(pair.to_light()), glm::vec3(pair.to_viewer())));
    };
}

} // namespace

void SessionOptions::options(Options &o) {
    const Option &dry = o.flag("--dry-run", &dry_run_,
                               "simulated lines, axes and camera in virtual time, no hardware");
    o.option("--fabric", &fabric_, "F.fabric.toml",
             "fabric that the camera of a dry run sees; without it, a diffuse grey")
        .needs(dry);
    o.flag("--wait", &wait_, "wait for a lamp that may not be lit yet; without it, an error");
    o.option("--tries", &tries_, "N", "tries of a frame or a movement").range(1, 100);
    o.flag("--json", &json_, "print the report as JSON");
}

/// The lines are let go before anything waits for a terminal that does not take the progress.
lab::SessionResult SessionOptions::result(const std::filesystem::path &folder, Console &console,
                                          const std::filesystem::path &plan) const {
    Operator people;
    lab::SessionJob job{.folder = folder,
                        .read = lab::read_frame_facts,
                        .wait = wait_,
                        .tries = tries_,
                        .library_threads = lab::other_threads(), // none is our own yet
                        .ask = [&](const std::string &what) { people.ask(what); },
                        .answered = [&] { return people.answered(); }};
    if (dry_run_)
        job.simulated_camera = [cloth = reflectance_of(fabric_)](const lab::RigFile &rig,
                                                                 lab::Clock &clock) {
            return std::make_unique<lab::VirtualCamera>(lab::VirtualScene{.cloth = cloth},
                                                        rig.camera, lab::VirtualCameraSettings{},
                                                        &clock);
        };
    if (!plan.empty()) // after the fabric: a wrong one leaves no folder
        lab::create_session(folder, plan, lab::read_plan(plan).rig);
    lab::ProgressRelay relay(console.progress());
    const SignalShield shield;
    return lab::run_session_job(job, relay.progress());
}

Status SessionOptions::run(const std::filesystem::path &folder, Console &console,
                           const std::filesystem::path &plan) const {
    const lab::SessionResult done = result(folder, console, plan);
    if (json_)
        std::cout << Json{{"schema", "tsuya-lab-run 1"},
                          {"planned", done.planned},
                          {"counted", done.counted},
                          {"missing", done.missing()}}
                         .text()
                  << "\n";
    else
        std::cout << done.counted << " of " << detail::counted(done.planned, "frame") << "\n"
                  << folder.string() << "\n";
    return done.missing() == 0 ? kDone : kCheckFailed;
}

} // namespace tsuya::program

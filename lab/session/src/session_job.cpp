#include "tsuya/lab/session_job.h"

#include "tsuya/lab/cameras.h"
#include "tsuya/lab/gpio_line.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/lab/supervisor.h"
#include "tsuya/sdk/error.h"

#include <algorithm>
#include <array>

#include <fcntl.h>
#include <unistd.h>

namespace tsuya::lab {
namespace {

// To read a large picture, or to store on a slow card, takes long and does not beat.
constexpr std::chrono::milliseconds kSilenceAtWork{5000};
constexpr std::chrono::milliseconds kAskAgain{100}; // whether the operator is ready
constexpr double kDryRunEpoch_s = 1.7e9; // of the virtual clock: equal runs have equal times
constexpr double kBetweenDryRuns_s = 86400;
constexpr char kAsk = 'a', kReady = '?';

/// The lines of a rig file, taken; a null pointer for a role that it does not have.
class RigLines {
  public:
    explicit RigLines(const RigFile &rig) {
        std::vector<NamedGpioLine> named;
        for (const auto &[role, settings] : rig.lines)
            named.push_back({.role = name_of(role), .settings = settings});
        check_gpio_lines(named);
        for (const auto &[role, settings] : rig.lines)
            if (is_output(role))
                outputs_[role] = std::make_unique<GpioLine>(settings);
            else
                inputs_[role] = std::make_unique<GpioInput>(settings);
    }
    OutputLine *output(LineRole role) const {
        const auto at = outputs_.find(role);
        return at == outputs_.end() ? nullptr : at->second.get();
    }
    InputLine *input(LineRole role) const {
        const auto at = inputs_.find(role);
        return at == inputs_.end() ? nullptr : at->second.get();
    }

  private:
    std::map<LineRole, std::unique_ptr<OutputLine>> outputs_{};
    std::map<LineRole, std::unique_ptr<InputLine>> inputs_{};
};

/// The operator is in front of the calling process; the work asks through it.
class OperatorPipe {
  public:
    explicit OperatorPipe(const SessionJob &job) : job_(job) {
        if (pipe2(ends_.data(), O_CLOEXEC | O_NONBLOCK) != 0)
            throw Error({"no pipe to the operator"});
    }
    ~OperatorPipe() {
        for (const int end : ends_)
            close(end);
    }
    OperatorPipe(const OperatorPipe &) = delete;
    OperatorPipe &operator=(const OperatorPipe &) = delete;

    /// In the calling process.
    void receive(std::string_view message) const {
        if (message.empty())
            return;
        if (message.front() == kAsk && job_.ask)
            job_.ask(std::string(message.substr(1)));
        if (message.front() != kReady || !job_.answered || !job_.answered())
            return;
        const char yes = 1;
        [[maybe_unused]] const ssize_t told = write(ends_[1], &yes, 1);
    }
    /// In the work.
    void ask(const std::string &what, Worker &worker, Clock &clock, Seconds hold,
             const std::atomic<bool> *stop) const {
        if (!job_.ask || !job_.answered)
            throw SessionFault({"nobody can be asked to " + what, "operator",
                                "expected a program that asks, or drives that need nobody"},
                               false);
        worker.send(kAsk + what.substr(0, Worker::kMaxMessage - 1));
        const auto deadline = clock.now() + std::chrono::round<std::chrono::nanoseconds>(hold);
        for (char yes = 0; read(ends_[0], &yes, 1) != 1;) {
            if (clock.now() >= deadline) // the lamp burns meanwhile
                throw SessionFault({"nobody has answered for the lamp's hold_s", "operator",
                                    "expected someone to " + what + ", then resume"},
                                   false);
            worker.send(std::string(1, kReady));
            if (!clock.sleep_until(clock.now() + kAskAgain, stop))
                throw Interrupted("stopped while the operator was asked");
        }
    }

  private:
    const SessionJob &job_;
    std::array<int, 2> ends_{};
};

std::unique_ptr<FrameCamera> camera_of(const RigFile &rig, Clock &clock, const CommandRun &how) {
    if (rig.camera.command.empty())
        return std::make_unique<TriggeredCamera>(rig.camera, clock, how.stop);
    return std::make_unique<CommandCamera>(rig.camera, clock, how);
}

SessionResult run_for_real(const SessionJob &job, const std::filesystem::path &rig_file,
                           const Progress &progress) {
    const RigFile rig = read_rig_file(rig_file);
    const RigLines lines(rig);
    const OperatorPipe people(job);
    OutputLine *const lamp = lines.output(LineRole::lamp);
    OutputLine *const shutter = lines.output(LineRole::shutter);
    const Supervision supervision{
        .lines = {lamp, shutter, lines.output(LineRole::half_press)},
        .silence = job.silence,
        .silence_at_work = kSilenceAtWork,
        .heartbeat = lines.output(LineRole::heartbeat),
        .receive = [&](std::string_view message) { people.receive(message); },
        .library_threads = job.library_threads};
    const auto work = [&](Worker &worker) {
        const Progress inner = worker.progress();
        SafetyClock clock(worker.clock(), lines.input(LineRole::interlock),
                          lines.input(LineRole::estop));
        const CommandRun how{.stop = inner.stop,
                             .on_group = [&](int group) { worker.command_group(group); }};
        RigMechanics mechanics(
            rig, clock,
            [&](const std::string &what) {
                people.ask(what, worker, clock, rig.lamp.hold, inner.stop);
            },
            how);
        const auto camera = camera_of(rig, clock, how);
        run_session(job.folder, rig,
                    {.lamp = lamp,
                     .shutter = shutter,
                     .half_press = lines.output(LineRole::half_press),
                     .busy = lines.input(LineRole::busy),
                     .mechanics = mechanics,
                     .camera = *camera,
                     .clock = clock,
                     .read = job.read,
                     .moments = moment_now},
                    {.lamp_log = rig.lamp.log,
                     .fault_log = fault_log_of(rig_file),
                     .wait = job.wait,
                     .tries = job.tries},
                    inner);
    };
    run_supervised(supervision, work, progress);
    const Session session = read_session(job.folder);
    return {.planned = session.plan.frames.size(), .counted = session.frames.size()};
}

/// Pictures of a rig and of a dry run do not stand in one session.
void check_is_the_same_kind(const std::filesystem::path &journal, bool dry) {
    for (const JournalEvent &event : read_journal(journal).events)
        if (event.kind == EventKind::session && (event.text("boot") == kDryRunBoot) != dry)
            throw Error(
                {dry ? "the session was begun on a rig" : "the session was begun as a dry run",
                 journal.string(), dry ? "expected no dry run" : "expected a dry run"});
}

/// The next of several dry runs of a session comes a day later.
double epoch_of(const std::filesystem::path &journal) {
    double last_s = 0;
    for (const JournalEvent &event : read_journal(journal).events)
        last_s = event.time_s;
    return last_s > 0 ? last_s + kBetweenDryRuns_s : kDryRunEpoch_s;
}

SessionResult run_dry(const SessionJob &job, const Progress &progress) {
    RigFile rig = read_rig_file(job.folder / "rig.toml");
    rig.camera = dry_run_camera(rig.camera);
    const double epoch_s = epoch_of(job.folder / "journal.jsonl");
    VirtualClock time;
    SimulatedInput interlock("interlock", time, true), estop("estop", time, false);
    SafetyClock clock(time, &interlock, &estop);
    SimulatedLine lamp("lamp", time), shutter("shutter", time);
    SimulatedMechanics mechanics(rig, clock);
    const auto camera = job.simulated_camera(rig, clock);
    const auto moment = [&] {
        const double s = Seconds(time.now()).count();
        return Moment{.boot = kDryRunBoot, .boottime_s = s, .time_s = epoch_s + s};
    };
    return run_session(job.folder, rig,
                       {.lamp = &lamp,
                        .shutter = &shutter,
                        .mechanics = mechanics,
                        .camera = *camera,
                        .clock = clock,
                        .read = job.read,
                        .moments = moment},
                       {.wait = job.wait, .tries = job.tries}, progress);
}

} // namespace

SessionResult run_session_job(const SessionJob &job, const Progress &progress) {
    const std::filesystem::path rig = read_plan(job.folder / "plan.jsonl").rig;
    const bool dry = static_cast<bool>(job.simulated_camera);
    check_is_the_same_kind(job.folder / "journal.jsonl", dry);
    if (dry)
        return run_dry(job, progress);
    check_same_rig_and_plan(job.folder, rig);
    return run_for_real(job, rig, progress);
}

} // namespace tsuya::lab

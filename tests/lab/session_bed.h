#pragma once
// A small rig without hardware, whose camera and mechanics fail when a test says so.

#include "samples/scratch.h"
#include "tsuya/lab/planning.h"
#include "tsuya/lab/session_run.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

#include <gtest/gtest.h>

#include <functional>
#include <sstream>

namespace tsuya::lab {

inline constexpr const char *kSmallRig = R"(schema = "tsuya-rig 1"
[lamp]
kind = "metal-halide"
serial = "T-1"
warm_up_s = 900
restrike_s = 900
min_on_s = 300
hold_s = 600
[camera]
command = ["camera", "{file}", "{exposure}"]
timeout_s = 5
exposures_s = [0.1, 1]
black = 100
saturation = 1000
e_per_dn = 2.5
read_noise_e = 4
[axes.lamp_theta]
drive = "command"
command = ["axis", "{axis}", "{deg}"]
[axes.lamp_phi]
drive = "command"
command = ["axis", "{axis}", "{deg}"]
[axes.camera]
drive = "command"
command = ["axis", "{axis}", "{deg}"]
move_s = 10
[axes.stage]
drive = "command"
command = ["axis", "{axis}", "{deg}"]
settle_s = 0.5
[white]
rho_std = 0.99
)";

/// A picture of a test's camera is a line of text.
inline std::string picture_text(const Shot &shot, double mean, const std::string &unique) {
    std::ostringstream text;
    text << "picture " << shot.planned.exposure_s << " " << mean << " " << unique << " end\n";
    return text.str();
}

inline FrameFacts read_picture(const std::filesystem::path &file, const RigCamera &, double) {
    std::istringstream text(read_file(file));
    std::string begin, unique, end;
    FrameFacts facts{.exposure_s = 0};
    text >> begin >> *facts.exposure_s >> facts.patch_mean >> unique >> end;
    if (begin != "picture" || end != "end")
        throw Error({"the picture is cut off", file.string(), "expected a whole one"});
    return facts;
}

/// Pictures whose only difference is the frame, so that two sessions of one plan give the same
/// ones. `on_expose` and `on_collect` may throw, or write something else and return true.
class BedCamera final : public FrameCamera {
  public:
    explicit BedCamera(Clock &clock) : clock_(clock) {}

    void expose(const Shot &shot) override {
        ++exposures;
        if (on_expose)
            on_expose(shot);
        static_cast<void>(clock_.sleep_until(
            clock_.now() +
                std::chrono::round<std::chrono::nanoseconds>(Seconds(shot.planned.exposure_s)),
            nullptr));
    }
    void collect(const Shot &shot) override {
        if (on_collect && on_collect(shot))
            return;
        write_file(shot.file, picture_of(shot));
    }
    std::string picture_of(const Shot &shot) {
        const std::string unique =
            shot.number ? std::to_string(*shot.number) : "white-" + std::to_string(shot.time_s);
        return picture_text(shot, white_mean ? white_mean() : 200, unique);
    }

    int exposures = 0;
    std::function<void(const Shot &)> on_expose{};
    std::function<bool(const Shot &)> on_collect{};
    std::function<double()> white_mean{};

  private:
    Clock &clock_;
};

class BedMechanics final : public Mechanics {
  public:
    BedMechanics(const RigFile &rig, Clock &clock) : simulated_(rig, clock) {}
    void move(AxisName axis, double position_deg) override {
        moves.emplace_back(axis, position_deg);
        if (on_move)
            on_move(axis);
        simulated_.move(axis, position_deg);
    }
    void place(FrameKind sample) override {
        samples.push_back(sample);
        simulated_.place(sample);
    }

    std::vector<std::pair<AxisName, double>> moves{};
    std::vector<FrameKind> samples{};
    std::function<void(AxisName)> on_move{};

  private:
    SimulatedMechanics simulated_;
};

/// One call of the program: its hardware and clocks. Time goes on from `epoch_s`.
struct BedRun {
    explicit BedRun(const RigFile &rig, double epoch = 1.7e9, std::string boot = "boot-1")
        : epoch_s(epoch), boot_id(std::move(boot)), mechanics(rig, clock) {}

    Moment moment() {
        const double s = Seconds(time.now()).count();
        return {.boot = boot_id, .boottime_s = boottime_s + s, .time_s = epoch_s + s};
    }
    SessionHardware hardware() {
        return {.lamp = &lamp,
                .shutter = &shutter,
                .mechanics = mechanics,
                .camera = camera,
                .clock = clock,
                .read = read_picture,
                .moments = [this] { return moment(); }};
    }
    SessionResult run(const std::filesystem::path &folder, const RigFile &rig,
                      const SessionSettings &settings = {}) {
        return run_session(folder, rig, hardware(), settings, {.stop = &stop});
    }
    void expect_off() const {
        EXPECT_FALSE(lamp.active());
        EXPECT_FALSE(shutter.active());
    }

    double epoch_s;
    std::string boot_id;
    double boottime_s = 0;
    VirtualClock time{};
    SimulatedInput interlock{"interlock", time, true}, estop{"estop", time, false};
    SafetyClock clock{time, &interlock, &estop};
    SimulatedLine lamp{"lamp", time}, shutter{"shutter", time};
    BedMechanics mechanics;
    BedCamera camera{clock};
    std::atomic<bool> stop{false};
};

/// A rig file, a plan of it, and the folder of a session.
class SessionBed {
  public:
    SessionBed() {
        write_file(rig_file(), kSmallRig);
        rig = read_rig_file(rig_file());
        plan = make_plan(rig, {.directions = views_named("few:45", Symmetry::orthotropic),
                               .views = "few:45",
                               .rig = rig_file()});
        write_plan(plan, plan_file());
    }
    std::filesystem::path rig_file() const { return scratch / "small.rig.toml"; }
    std::filesystem::path plan_file() const { return scratch / "small.plan.jsonl"; }
    std::filesystem::path folder() const { return scratch / "session"; }
    void create() const { create_session(folder(), plan_file(), rig_file()); }
    /// Creates the session and runs it undisturbed.
    Session finished() const {
        create();
        BedRun run(rig);
        run.run(folder(), rig);
        return read_session(folder());
    }

    scene::Scratch scratch;
    RigFile rig{};
    Plan plan{};
};

/// A session that is made, and what its runs leave.
class SessionRunTest : public testing::Test {
  protected:
    SessionRunTest() { bed.create(); }

    std::vector<EventKind> kinds() const {
        std::vector<EventKind> kinds;
        for (const JournalEvent &event : read_journal(bed.folder() / "journal.jsonl").events)
            kinds.push_back(event.kind);
        return kinds;
    }
    Session session() const { return read_session(bed.folder()); }
    /// What the run throws.
    template <class E> Problem problem_of(BedRun &run, const SessionSettings &settings = {}) {
        try {
            run.run(bed.folder(), bed.rig, settings);
        } catch (const E &error) {
            run.expect_off();
            return error.problems().front();
        }
        return {.what = "no such error"};
    }
    SessionSettings with_logs() const {
        return {.lamp_log = bed.scratch / "lamp.log", .fault_log = bed.scratch / "faults.jsonl"};
    }

    SessionBed bed;
};

/// The pictures that count, by number: what a table is made of.
inline std::vector<std::string> pictures_of(const Session &session) {
    std::vector<std::string> pictures;
    for (const CountedFrame &frame : session.frames)
        pictures.push_back(read_file(frame.file));
    return pictures;
}

} // namespace tsuya::lab

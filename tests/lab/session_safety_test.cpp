// What turns the lamp off at once, and what is told where it may still be on.
#include "tsuya/lab/session_run.h"

#include "lab/session_bed.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;

using SessionSafety = SessionRunTest;

// The housing is opened in the middle of an exposure: that picture never counts, the lamp is off at
// once, and nothing runs until someone has acknowledged it.
TEST_F(SessionSafety, EndAtOnceWhereTheHousingIsOpened) {
    BedRun run(bed.rig);
    std::chrono::nanoseconds opened{0};
    run.camera.on_expose = [&](const Shot &shot) {
        if (shot.number != 7u)
            return;
        opened = run.time.now() + 303ms; // between two looks at the level
        run.time.at(opened, [&] { run.interlock.change(false); });
        run.time.at(opened + 5ms, [&] { run.interlock.change(true); }); // and is closed again
    };
    EXPECT_EQ(problem_of<SessionFault>(run, with_logs()).where, "interlock");
    EXPECT_LE(run.lamp.transitions().back().time, opened + SafetyClock::kLook);
    EXPECT_EQ(session().frames.size(), 7u);
    EXPECT_EQ(latched_fault(with_logs().fault_log), "interlock: the interlock is open");

    BedRun early(bed.rig, 1.7e9 + 1e5);
    EXPECT_EQ(problem_of<Error>(early, with_logs()).what,
              "a fault was not acknowledged yet: interlock: the interlock is open");
    EXPECT_TRUE(early.lamp.transitions().empty());
    EXPECT_THROW(acknowledge_fault(with_logs().fault_log, "", 0), Error);
    acknowledge_fault(with_logs().fault_log, "the door was ajar", 1.7e9);
    EXPECT_THROW(acknowledge_fault(with_logs().fault_log, "again", 0), Error);

    BedRun late(bed.rig, 1.7e9 + 1e5);
    late.boottime_s = 1e5;
    EXPECT_EQ(late.run(bed.folder(), bed.rig, with_logs()).missing(), 0u);
    EXPECT_EQ(pictures_of(session()), pictures_of(SessionBed().finished()));
}

// A full disk, say. What opened is told all the same.
TEST_F(SessionSafety, TellAFaultThatCannotBeLatched) {
    BedRun run(bed.rig);
    run.camera.on_expose = [&](const Shot &) {
        std::filesystem::create_directory(with_logs().fault_log); // which was to be a file
        run.interlock.change(false);
    };
    try {
        run.run(bed.folder(), bed.rig, with_logs());
        FAIL() << "no error";
    } catch (const Error &error) {
        run.expect_off();
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_TRUE(error.problems()[0].what.starts_with("the fault is not latched: "));
        EXPECT_EQ(error.problems()[0].where, with_logs().fault_log.string());
        EXPECT_EQ(error.problems()[1].where, "interlock");
    }
    EXPECT_EQ(kinds().back(), EventKind::note) << "the journal ends as it should";
}

// A camera that does not sleep on the watched clock hides nothing.
TEST_F(SessionSafety, LookAtTheHousingAfterEachExposure) {
    struct Unwatched final : FrameCamera {
        explicit Unwatched(BedRun &bed_run) : run(bed_run) {}
        void expose(const Shot &shot) override {
            if (shot.number == 7u) {
                run.interlock.change(false);
                run.interlock.change(true);
            }
            run.time.advance(1s);
        }
        void collect(const Shot &shot) override {
            write_file(shot.file, run.camera.picture_of(shot));
        }
        BedRun &run;
    };
    BedRun run(bed.rig);
    Unwatched camera(run);
    const SessionHardware usual = run.hardware();
    const SessionHardware hardware{.lamp = usual.lamp,
                                   .shutter = usual.shutter,
                                   .mechanics = usual.mechanics,
                                   .camera = camera,
                                   .clock = usual.clock,
                                   .read = usual.read,
                                   .moments = usual.moments};
    EXPECT_THROW(run_session(bed.folder(), bed.rig, hardware, {}), SessionFault);
    run.expect_off();
    for (const JournalEvent &event : read_journal(bed.folder() / "journal.jsonl").events)
        EXPECT_FALSE(event.kind == EventKind::close && event.frame == 7u);
}

TEST_F(SessionSafety, DoNotBeginWithTheStopPressedOrTheHousingOpen) {
    BedRun run(bed.rig);
    run.estop.change(true);
    EXPECT_EQ(problem_of<SessionFault>(run).where, "estop");
    EXPECT_TRUE(run.lamp.transitions().empty());
    BedRun other(bed.rig);
    other.interlock.change(false);
    EXPECT_EQ(problem_of<SessionFault>(other).where, "interlock");
}

TEST_F(SessionSafety, ALineThatFailsEndsTheSession) {
    struct Broken final : OutputLine {
        void set(bool active) override {
            if (active && ++openings > 3)
                throw Error({"the wire is broken", "shutter", ""});
        }
        const std::string &name() const override { return name_; }
        int openings = 0;
        std::string name_ = "shutter";
    } broken;
    BedRun run(bed.rig);
    SessionHardware hardware = run.hardware();
    hardware.shutter = &broken;
    EXPECT_THROW(run_session(bed.folder(), bed.rig, hardware, {}), SessionFault);
    run.expect_off();
}

TEST_F(SessionSafety, TellWhereTheLampMayStillBeOn) {
    struct Stuck final : OutputLine {
        void set(bool active) override {
            if (!active)
                throw Error({"the relay is stuck", "lamp", ""});
        }
        const std::string &name() const override { return name_; }
        std::string name_ = "lamp";
    } stuck;
    BedRun run(bed.rig);
    run.time.at(950s, [&] { run.interlock.change(false); });
    SessionHardware hardware = run.hardware();
    hardware.lamp = &stuck;
    try {
        run_session(bed.folder(), bed.rig, hardware, {});
        FAIL() << "no error";
    } catch (const Error &error) {
        ASSERT_EQ(error.problems().size(), 2u);
        EXPECT_TRUE(error.problems()[0].what.starts_with("may still be on"));
        EXPECT_EQ(error.problems()[1].where, "interlock");
    }
}

} // namespace
} // namespace tsuya::lab

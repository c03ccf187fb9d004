#include "tsuya/lab/session_run.h"

#include "lab/session_bed.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;

using SessionRuns = SessionRunTest;

TEST_F(SessionRuns, TakeEveryPlannedFrameOnce) {
    BedRun run(bed.rig);
    const SessionResult result = run.run(bed.folder(), bed.rig);
    run.expect_off();
    EXPECT_EQ(result.planned, 16u);
    EXPECT_EQ(result.missing(), 0u);
    const Session done = session();
    ASSERT_EQ(done.frames.size(), 16u);
    EXPECT_TRUE(done.missing.empty());
    EXPECT_TRUE(done.rejected.empty());
    for (const CountedFrame &frame : done.frames) {
        EXPECT_EQ(frame.strike, 1);
        EXPECT_GT(frame.time_s, 1.7e9 + 900);
        EXPECT_EQ(frame.exposure_s, frame.planned.exposure_s);
    }
    // Exposed for 0.1 and 1 s with nothing between them but the camera: middles 0.55 s apart and
    // the 50 ms for which a picture is looked at.
    EXPECT_NEAR(done.frames[1].time_s - done.frames[0].time_s, 0.05 + 0.5 + 0.05, 1e-3);
    EXPECT_EQ(run.mechanics.samples, (std::vector<FrameKind>{FrameKind::white, FrameKind::trap,
                                                             FrameKind::cloth, FrameKind::white}));
    EXPECT_EQ(kinds().back(), EventKind::note);
}

// The shutter opens for every picture but the dark ones, and not before the lamp is warm.
TEST_F(SessionRuns, OpenTheShutterUnderAWarmLamp) {
    BedRun run(bed.rig);
    run.run(bed.folder(), bed.rig);
    ASSERT_EQ(run.lamp.transitions().size(), 2u);
    EXPECT_EQ(run.lamp.transitions()[0].time, 0s);
    const auto &opened = run.shutter.transitions();
    EXPECT_GE(opened.front().time, 900s);
    const std::size_t dark = 4, beside = session().warm_up.size();
    EXPECT_EQ(opened.size(), 2 * (16 - dark + beside));
    EXPECT_EQ(run.camera.exposures, static_cast<int>(16 + beside));
    for (std::size_t i = 0; i < opened.size(); i += 2)
        EXPECT_TRUE(opened[i].active && !opened[i + 1].active);
}

// Three white frames a minute apart agree to 0.3 %: the lamp settles to 1 % in 10 minutes more.
TEST_F(SessionRuns, WaitForWhiteFramesToAgree) {
    BedRun run(bed.rig);
    run.camera.white_mean = [&] {
        const double t = Seconds(run.time.now()).count() - 900;
        return 500 * (1 - 0.1 * std::exp(-t / 180));
    };
    run.run(bed.folder(), bed.rig);
    std::vector<CountedFrame> white = session().warm_up;
    ASSERT_GE(white.size(), 8u);
    // Over two minutes the mean changes by 0.1 exp(-t / 180) (1 - exp(-2 / 3)) of itself.
    const double began = white.back().time_s - 1.7e9 - 900 - 120;
    const double change = 0.1 * std::exp(-began / 180) * (1 - std::exp(-120. / 180));
    EXPECT_LT(change, 0.0031);
    EXPECT_GT(change * std::exp(60. / 180), 0.0029); // a minute earlier they did not agree
    BedRun never(bed.rig, 1.7e9 + 1e5);
    never.camera.white_mean = [&] { return 300 + 10 * (never.camera.exposures % 2); };
    scene::Scratch other;
    create_session(other / "s", bed.plan_file(), bed.rig_file());
    EXPECT_THROW(never.run(other / "s", bed.rig), SessionFault);
    never.expect_off();
}

TEST_F(SessionRuns, ChooseAnExposureThatDoesNotClipTheStandard) {
    BedRun run(bed.rig);
    run.camera.on_collect = [&](const Shot &shot) {
        const double mean = shot.planned.exposure_s > 0.5 ? 900 : 90;
        write_file(shot.file, picture_text(shot, mean, std::to_string(run.camera.exposures)));
        return true;
    };
    run.run(bed.folder(), bed.rig);
    const std::vector<CountedFrame> white = session().warm_up;
    EXPECT_EQ(white[0].planned.exposure_s, 1);
    EXPECT_EQ(white[1].planned.exposure_s, 0.1);
    EXPECT_EQ(white.back().planned.exposure_s, 0.1);
}

// Each fault of a picture, at its first two tries: put aside with its reason, and taken again.
// A session that goes on under its second light tells whether the lamp is warm by that light.
TEST(SessionRunsOfLights, TakeTheWhiteOfTheNextLight) {
    SessionBed bed;
    const auto pair = [](double theta_i_deg, double phi_i_deg) {
        return DirectionPair{.theta_i = theta_i_deg * kDegree,
                             .phi_i = phi_i_deg * kDegree,
                             .theta_r = 60 * kDegree,
                             .phi_r = 3};
    };
    write_plan(make_plan(bed.rig, {.directions = {.pairs = {pair(30, 0), pair(30, 45)}}}),
               bed.plan_file());
    bed.create();
    BedRun run(bed.rig);
    run.camera.on_expose = [&](const Shot &shot) { run.stop = run.stop || shot.number == 13u; };
    EXPECT_THROW(run.run(bed.folder(), bed.rig), Interrupted);
    BedRun again(bed.rig, 1.7e9 + 1e5);
    again.run(bed.folder(), bed.rig);
    const Session session = read_session(bed.folder());
    EXPECT_TRUE(session.missing.empty());
    EXPECT_NEAR(session.warm_up.front().planned.directions.phi_i, 0, 1e-9);
    EXPECT_NEAR(session.warm_up.back().planned.directions.phi_i, 45 * kDegree, 1e-9);
}

TEST_F(SessionRuns, PutBadPicturesAsideAndTakeThemAgain) {
    struct Case {
        std::string expected;
        std::function<void(BedRun &, const Shot &)> write;
    };
    const std::vector<Case> cases{
        {"no picture came", [](BedRun &, const Shot &) {}},
        {"the picture is empty", [](BedRun &, const Shot &s) { write_file(s.file, ""); }},
        {"the picture is cut off",
         [](BedRun &, const Shot &s) { write_file(s.file, "picture 1 2"); }},
        {"the picture is a copy of an earlier one",
         [](BedRun &, const Shot &s) {
             Shot earlier = s;
             earlier.planned.exposure_s = 1;
             write_file(s.file, picture_text(earlier, 200, "1"));
         }},
        {"the picture was exposed for",
         [](BedRun &, const Shot &s) {
             Shot wrong = s;
             wrong.planned.exposure_s *= 1.11;
             write_file(s.file, picture_text(wrong, 200, "x"));
         }},
        {"busy",
         [](BedRun &, const Shot &) {
             throw Error({"busy", "camera", ""});
         }},
        {"the picture does not stop growing",
         [](BedRun &run, const Shot &s) {
             write_file(s.file, "p");
             for (int i = 1; i < 200; ++i)
                 run.time.at(run.time.now() + i * 30ms, [file = s.file] {
                     if (std::filesystem::exists(file))
                         write_file(file, read_file(file) + "p");
                 });
         }},
    };
    const std::vector<std::string> good = pictures_of(SessionBed().finished());
    for (const Case &c : cases) {
        SessionBed other;
        other.create();
        BedRun run(other.rig);
        int bad = 0;
        run.camera.on_collect = [&](const Shot &shot) {
            if (shot.number != 7u || ++bad > 2)
                return false;
            c.write(run, shot);
            return true;
        };
        const SessionResult result = run.run(other.folder(), other.rig);
        run.expect_off();
        EXPECT_EQ(result.missing(), 0u) << c.expected;
        EXPECT_EQ(bad, 3) << c.expected;
        EXPECT_EQ(run.lamp.transitions().size(), 2u) << "the lamp stays lit";
        const Session done = read_session(other.folder());
        ASSERT_EQ(done.rejected.size(), 2u) << c.expected;
        for (const RejectedFrame &rejected : done.rejected) {
            EXPECT_TRUE(rejected.why.starts_with(c.expected)) << rejected.why;
            EXPECT_EQ(rejected.number, 7u);
            EXPECT_TRUE(rejected.file.empty() || std::filesystem::exists(rejected.file));
        }
        EXPECT_EQ(pictures_of(done), good) << c.expected;
    }
}

TEST_F(SessionRuns, LeaveAFrameThatFailsAlwaysForTheNextRun) {
    BedRun run(bed.rig);
    run.camera.on_collect = [](const Shot &shot) { return shot.number == 3u; };
    EXPECT_EQ(run.run(bed.folder(), bed.rig).missing(), 1u);
    EXPECT_EQ(session().missing, std::vector<std::size_t>{3});
    BedRun again(bed.rig, 1.7e9 + 1e5);
    EXPECT_EQ(again.run(bed.folder(), bed.rig).missing(), 0u);
    EXPECT_EQ(session().frames[3].strike, 2);
    EXPECT_EQ(session().frames[4].strike, 1);
}

TEST_F(SessionRuns, EndWhereNothingSucceedsForTheHoldTime) {
    BedRun run(bed.rig);
    run.mechanics.on_move = [&](AxisName axis) {
        if (axis != AxisName::stage || session().warm_up.empty())
            return;
        run.time.advance(300s);
        throw Error({"no answer", "/dev/ttyUSB0", ""});
    };
    EXPECT_EQ(problem_of<SessionFault>(run).where, "/dev/ttyUSB0");
    EXPECT_LT(run.lamp.transitions().back().time, 900s + 200s + 4 * 300s);
}

TEST_F(SessionRuns, KeepToTheShuttersDutyAndInterval) {
    bed.rig.shutter.max_duty = 0.25;
    bed.rig.shutter.min_interval = Seconds(2);
    BedRun run(bed.rig);
    run.run(bed.folder(), bed.rig);
    const auto &moved = run.shutter.transitions();
    for (std::size_t i = 0; i + 2 < moved.size(); i += 2) {
        const auto open = moved[i + 1].time - moved[i].time;
        EXPECT_GE(moved[i + 2].time - moved[i].time,
                  std::max<std::chrono::nanoseconds>(4 * open, 2s));
    }
}

// With a command the picture begins when the blades are open; what the line triggers is late as a
// whole.
TEST_F(SessionRuns, WaitForTheBladesOfTheShutter) {
    bed.rig.shutter.lag = Seconds(0.25);
    for (const bool triggers : {false, true}) {
        if (triggers)
            bed.rig.camera.command.clear();
        SessionBed other;
        other.create();
        BedRun run(bed.rig);
        std::vector<std::chrono::nanoseconds> began, moved;
        run.camera.on_expose = [&](const Shot &) { began.push_back(run.time.now()); };
        run.mechanics.on_move = [&](AxisName) { moved.push_back(run.time.now()); };
        run.run(other.folder(), bed.rig);
        const auto &lines = run.shutter.transitions();
        const CountedFrame frame = read_session(other.folder()).warm_up.at(1);
        const auto open = lines[2].time, shut = lines[3].time; // the second picture
        EXPECT_EQ(began[1] - open, triggers ? 0ms : 250ms);
        EXPECT_EQ(shut - open, 1s * frame.exposure_s + (triggers ? 0ms : 250ms));
        EXPECT_NEAR(frame.time_s - 1.7e9 - Seconds(open).count(), 0.25 + 0.5 * frame.exposure_s,
                    1e-6);
        for (std::size_t i = 1; i < lines.size(); i += 2)
            for (const auto time : moved)
                EXPECT_FALSE(time >= lines[i].time && time < lines[i].time + 250ms);
    }
}

TEST_F(SessionRuns, AreStoppedInTheMiddleOfAnything) {
    for (const auto at : {10s, 900s, 960s, 1070s, 1100s}) {
        SessionBed other;
        other.create();
        BedRun run(other.rig);
        run.time.at(at, [&] { run.stop = true; });
        EXPECT_THROW(run.run(other.folder(), other.rig), Interrupted) << at.count();
        run.expect_off();
        EXPECT_LE(run.lamp.transitions().back().time, at + 31s); // simulated drives do not stop
        BedRun again(other.rig, 1.7e9 + 1e5);
        again.run(other.folder(), other.rig);
        EXPECT_EQ(pictures_of(read_session(other.folder())), pictures_of(SessionBed().finished()));
    }
}

TEST_F(SessionRuns, LeaveTheLampOffForItsTime) {
    BedRun first(bed.rig);
    first.time.at(100s, [&] { first.stop = true; });
    EXPECT_THROW(first.run(bed.folder(), bed.rig, with_logs()), Interrupted);
    BedRun early(bed.rig, 1.7e9 + 400);
    early.boottime_s = 400;
    EXPECT_EQ(problem_of<SessionFault>(early, with_logs()).what,
              "the lamp may not be lit again for 10 min 0 s");
    SessionSettings waiting = with_logs();
    waiting.wait = true;
    EXPECT_EQ(early.run(bed.folder(), bed.rig, waiting).missing(), 0u);
    EXPECT_EQ(early.lamp.transitions().front().time, 600s);
    EXPECT_EQ(session().frames[0].strike, 2);
    EXPECT_NEAR(session().frames[0].lamp_hours, (100 + 900 + 180) / 3600., 0.02);
}

TEST_F(SessionRuns, RefuseAFolderThatIsInUse) {
    const JournalWriter held(bed.folder() / "journal.jsonl");
    BedRun run(bed.rig);
    EXPECT_EQ(problem_of<Error>(run).what,
              "another process writes it: " + std::to_string(getpid()));
}

TEST_F(SessionRuns, NeverOverwriteAPicture) {
    write_file(bed.folder() / "frames" / "000002.tif", "not confirmed");
    BedRun run(bed.rig);
    run.run(bed.folder(), bed.rig);
    ASSERT_EQ(session().rejected.size(), 1u);
    EXPECT_EQ(read_file(session().rejected[0].file), "not confirmed");
    EXPECT_EQ(session().rejected[0].file.filename(), "000002-1.tif");
}

} // namespace
} // namespace tsuya::lab

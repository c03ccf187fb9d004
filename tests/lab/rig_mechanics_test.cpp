#include "tsuya/lab/rig_mechanics.h"

#include "lab/grbl_stand_in.h"
#include "samples/scratch.h"
#include "tsuya/lab/cameras.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"
#include "tsuya/sdk/progress.h"

#include <gtest/gtest.h>

#include <csignal>

namespace tsuya::lab {
namespace {

using namespace std::chrono_literals;
using scene::Scratch;
using test::GrblStandIn;

template <class Call> std::string error_of(const Call &call) {
    try {
        call();
    } catch (const Error &error) {
        return error.what();
    }
    return "no error";
}

std::vector<std::string> shell(const std::string &text) { return {"/bin/sh", "-c", text}; }

bool is_there(int group) { return kill(-group, 0) == 0; }

TEST(CommandRuns, FillTheirWords) {
    EXPECT_EQ(filled_in({"a", "{x}={y}", "{x}{x}"}, {{"x", "{y}1"}, {"y", "2"}}),
              (std::vector<std::string>{"a", "{y}1=2", "{y}1{y}1"}));
    EXPECT_EQ(filled_in({"{z}{", "}{x"}, {{"x", "1"}}), (std::vector<std::string>{"{z}{", "}{x"}));
}

TEST(CommandRuns, ReturnWithStatus0AndTellOthers) {
    SteadyClock clock;
    EXPECT_NO_THROW(run_command(shell("exit 0"), clock));
    EXPECT_EQ(error_of([&] { run_command(shell("echo no card >&2; exit 3"), clock); }),
              "/bin/sh: the program returned status 3: no card; expected status 0");
    EXPECT_EQ(error_of([&] { run_command({"no-such-program"}, clock); }),
              "no-such-program: the program cannot be started: No such file or directory; expected "
              "a program that is installed");
    EXPECT_EQ(error_of([&] { run_command(shell("kill -9 $$"), clock); }),
              "/bin/sh: the program was killed by Killed; expected status 0");
}

// Also what the program has started is gone: its own child, in the background.
TEST(CommandRuns, AreKilledWithTheirGroupAfterTheTimeout) {
    SteadyClock clock;
    int group = 0, last = -1;
    const CommandRun how{.timeout = Seconds(0.2), .on_group = [&](int told) {
                             group = told > 0 ? told : group;
                             last = told;
                         }};
    EXPECT_EQ(error_of([&] { run_command(shell("sleep 60 & sleep 60"), clock, how); }),
              "/bin/sh: the program was killed: it was not done in time; expected an end within "
              "its timeout_s");
    EXPECT_GT(group, 0);
    EXPECT_EQ(last, 0);
    for (int i = 0; i < 200 && is_there(group); ++i)
        static_cast<void>(clock.sleep_until(clock.now() + 10ms, nullptr));
    EXPECT_FALSE(is_there(group));
}

TEST(CommandRuns, EndAtAStopAndInheritNoFile) {
    SteadyClock clock;
    const std::atomic<bool> stop{true};
    EXPECT_THROW(run_command(shell("sleep 60"), clock, {.stop = &stop}), Interrupted);
    const Scratch scratch;
    const std::string list = (scratch / "files").string();
    run_command(shell("ls /proc/self/fd > " + list), clock);
    EXPECT_EQ(read_file(list), "0\n1\n2\n3\n"); // 3: the folder that ls reads
}

TEST(Cameras, AProgramGetsFileAndExposure) {
    const Scratch scratch;
    SteadyClock clock;
    const RigCamera shell_camera{.command = shell("echo {exposure} > {file}")};
    CommandCamera(shell_camera, clock, {})
        .expose({.planned = {.exposure_s = 0.25}, .file = scratch / "a.tif"});
    EXPECT_EQ(read_file(scratch / "a.tif"), "0.25\n");
    const Shot shot{.planned = {.exposure_s = 0.25}, .file = scratch / "a b.tif"};
    const RigCamera quoted{.command = {"/usr/bin/touch", "{file}"}};
    CommandCamera(quoted, clock, {}).expose(shot);
    EXPECT_TRUE(std::filesystem::exists(shot.file)); // no shell splits the name
}

TEST(Cameras, ThePictureThatArrivesIsTaken) {
    const Scratch scratch;
    std::filesystem::create_directories(scratch / "in");
    std::filesystem::create_directories(scratch / "out");
    write_file(scratch / "in" / "old.CR2", "old");
    SteadyClock clock;
    const RigCamera rig{.watch_folder = scratch / "in", .timeout = Seconds(1), .extension = "cr2"};
    TriggeredCamera camera(rig, clock, nullptr);
    const Shot shot{.planned = {.exposure_s = 0.01}, .file = scratch / "out" / "1.cr2"};
    camera.expose(shot);
    write_file(scratch / "in" / "new.jpg", "small");
    write_file(scratch / "in" / "new.CR2", "new");
    camera.collect(shot);
    EXPECT_EQ(read_file(shot.file), "new");
    EXPECT_FALSE(std::filesystem::exists(scratch / "in" / "new.CR2"));
    camera.expose(shot);
    EXPECT_NE(error_of([&] { camera.collect(shot); }).find("0 pictures arrived"),
              std::string::npos);
}

/// A rig of one controller.
struct GrblBed {
    GrblBed() {
        rig.axes[0] = {.drive = AxisDrive::grbl, .port = stand_in.port(), .timeout = Seconds(5)};
    }
    std::string error_of_move(double position_deg) {
        return error_of([&] { mechanics.move(AxisName::lamp_theta, position_deg); });
    }

    GrblStandIn stand_in;
    RigFile rig{};
    SteadyClock clock;
    std::atomic<bool> stop{false};
    RigMechanics mechanics{rig, clock, {}, {.stop = &stop}};
};

// `ok` comes at once; the movement takes 400 ms more.
TEST(Grbl, HomesFirstAndWaitsForTheArrival) {
    GrblBed bed;
    EXPECT_EQ(bed.error_of_move(30), "no error");
    EXPECT_EQ(bed.stand_in.homings, 1);
    const auto begin = bed.clock.now();
    EXPECT_EQ(bed.error_of_move(45.5), "no error");
    EXPECT_GE(bed.clock.now() - begin, GrblStandIn::kMove);
    EXPECT_EQ(bed.stand_in.homings, 1);
    EXPECT_EQ(bed.stand_in.moves, 2);
}

TEST(Grbl, HomesAgainAfterAnAlarm) {
    GrblBed bed;
    bed.stand_in.alarms_at_move = 1;
    EXPECT_NE(bed.error_of_move(30).find("ALARM:1"), std::string::npos);
    EXPECT_EQ(bed.error_of_move(30), "no error");
    EXPECT_EQ(bed.stand_in.homings, 2);
}

TEST(Grbl, TellsSilenceAndWrongPositions) {
    GrblBed bed;
    bed.rig.axes[0].timeout = Seconds(1);
    EXPECT_EQ(bed.error_of_move(10), "no error");
    bed.stand_in.short_by = 0.2;
    EXPECT_NE(bed.error_of_move(30).find("stands at 29.8"), std::string::npos);
    bed.stand_in.short_by = 0;
    bed.stand_in.silent = true;
    EXPECT_NE(bed.error_of_move(40).find("no answer in time"), std::string::npos);
    bed.stand_in.silent = false;
    bed.rig.axes[0].timeout = Seconds(5);
    EXPECT_EQ(bed.error_of_move(40), "no error");
    EXPECT_NE(error_of([&] {
                  GrblController("/dev/null/x", bed.clock, nullptr);
              }).find("cannot be opened"),
              std::string::npos);
}

TEST(Grbl, PutsHalfLinesTogether) {
    GrblBed bed;
    bed.stand_in.half_lines = true;
    EXPECT_EQ(bed.error_of_move(30), "no error");
}

TEST(Grbl, HoldsAtAStop) {
    GrblBed bed;
    EXPECT_EQ(bed.error_of_move(30), "no error");
    bed.stop = true;
    EXPECT_THROW(bed.mechanics.move(AxisName::lamp_theta, 10), Interrupted);
    for (int i = 0; i < 100 && bed.stand_in.holds == 0; ++i)
        static_cast<void>(bed.clock.sleep_until(bed.clock.now() + 10ms, nullptr));
    EXPECT_EQ(bed.stand_in.holds, 1);
}

TEST(Grbl, TakesReportsApart) {
    GrblStatus status;
    EXPECT_TRUE(parse_grbl_status("<Hold:0|MPos:1.5,-2.000|FS:0,0>", status));
    EXPECT_EQ(status.state, "Hold");
    EXPECT_EQ(status.axes, 2u);
    EXPECT_EQ(status.position[1], -2);
    for (const char *wrong : {"", "ok", "<Idle>", "<Idle|MPos:", "[MSG:x]"})
        EXPECT_FALSE(parse_grbl_status(wrong, status)) << wrong;
}

TEST(RigMechanicsOf, AxesAndSamplesAsTheFileSays) {
    const Scratch scratch;
    SteadyClock clock;
    RigFile rig;
    rig.axes[3] = {.drive = AxisDrive::command,
                   .command = shell("echo {axis} {deg} > " + (scratch / "said").string())};
    std::vector<std::string> asked;
    RigMechanics mechanics(rig, clock, [&](const std::string &what) { asked.push_back(what); }, {});
    mechanics.move(AxisName::stage, -12.5);
    EXPECT_EQ(read_file(scratch / "said"), "stage -12.5\n");
    mechanics.move(AxisName::camera, 45);
    mechanics.place(FrameKind::white);
    EXPECT_EQ(asked, (std::vector<std::string>{"turn camera to 45 degrees",
                                               "put the white standard under the camera"}));
    rig.sample = {.drive = AxisDrive::command,
                  .command = shell("echo {sample} > " + (scratch / "said").string())};
    mechanics.place(FrameKind::trap);
    EXPECT_EQ(read_file(scratch / "said"), "trap\n");
}

} // namespace
} // namespace tsuya::lab

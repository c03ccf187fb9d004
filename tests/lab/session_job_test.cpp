#include "tsuya/lab/session_job.h"

#include "lab/session_bed.h"
#include "tsuya/lab/session_status.h"

#include <gtest/gtest.h>

namespace tsuya::lab {
namespace {

/// The pictures of the bed's camera by a shell command: the program of a real session.
constexpr const char *kShellCamera = "n=$(basename {file}); echo picture {exposure} 200 $n end > "
                                     "{file}";

/// The small rig with times of a second or less, whose axes are commands.
std::string quick_rig() {
    std::string text = kSmallRig;
    const auto set = [&](const std::string &from, const std::string &to) {
        for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
            text.replace(at, from.size(), to);
    };
    set("warm_up_s = 900", "warm_up_s = 0.1");
    set("restrike_s = 900", "restrike_s = 0");
    set("min_on_s = 300", "min_on_s = 0");
    set("[\"axis\", \"{axis}\", \"{deg}\"]", "[\"/bin/true\", \"{axis}\", \"{deg}\"]");
    set("exposures_s = [0.1, 1]", "exposures_s = [0.1]");
    set("[\"camera\", \"{file}\", \"{exposure}\"]",
        std::string("[\"/bin/sh\", \"-c\", \"") + kShellCamera + "\"]");
    return text;
}

constexpr const char *kSampleCommand = "[sample]\ndrive = \"command\"\n"
                                       "command = [\"/bin/true\", \"{sample}\"]\n";

/// A session of the quick rig, with more sections.
void create_quick(SessionBed &bed, const std::string &sections = "", double hold_s = 600) {
    std::string text = quick_rig();
    text.replace(text.find("hold_s = 600"), 12, "hold_s = " + std::to_string(hold_s));
    write_file(bed.rig_file(), text + sections);
    bed.rig = read_rig_file(bed.rig_file());
    write_plan(make_plan(bed.rig, {.directions = views_named("few:45", Symmetry::orthotropic),
                                   .rig = bed.rig_file()}),
               bed.plan_file());
    bed.create();
}

SessionJob dry_job(const SessionBed &bed) {
    return {.folder = bed.folder(),
            .read = read_picture,
            .simulated_camera = [](const RigFile &, Clock &clock) {
                return std::make_unique<BedCamera>(clock);
            }};
}

constexpr std::chrono::seconds kSilence{2}; // a busy computer is no fault of the work

TEST(SessionJobs, ADryRunTakesNoTimeAndGivesTheSameAgain) {
    const SessionBed a, b;
    a.create();
    b.create();
    EXPECT_EQ(run_session_job(dry_job(a)).missing(), 0u);
    EXPECT_EQ(run_session_job(dry_job(b)).missing(), 0u);
    EXPECT_EQ(pictures_of(read_session(a.folder())), pictures_of(read_session(b.folder())));
    const Session first = read_session(a.folder()), second = read_session(b.folder());
    for (std::size_t i = 0; i < first.frames.size(); ++i)
        EXPECT_EQ(first.frames[i].time_s, second.frames[i].time_s);
    EXPECT_FALSE(std::filesystem::exists(fault_log_of(a.rig_file())));
    EXPECT_TRUE(first.dry_run);
    EXPECT_FALSE(SessionBed().finished().dry_run);
}

TEST(SessionJobs, DryAndRealPicturesDoNotMix) {
    const SessionBed bed;
    bed.create();
    run_session_job(dry_job(bed));
    SessionJob job = dry_job(bed);
    job.simulated_camera = {};
    EXPECT_THROW(run_session_job(job), Error);
}

TEST(SessionJobs, StatusTellsHowFarASessionIs) {
    const SessionBed bed;
    bed.create();
    SessionJob job = dry_job(bed);
    job.simulated_camera = [](const RigFile &, Clock &clock) {
        auto camera = std::make_unique<BedCamera>(clock);
        camera->on_collect = [](const Shot &shot) { return shot.number == 3u; };
        return camera;
    };
    EXPECT_EQ(run_session_job(job).missing(), 1u);
    const SessionStatus status = session_status(bed.folder());
    EXPECT_EQ(status.planned, 16u);
    EXPECT_EQ(status.counted, 15u);
    EXPECT_EQ(status.rejected, 3u);
    EXPECT_EQ(status.runs, 1);
    EXPECT_EQ(status.strikes, 1);
    EXPECT_FALSE(status.lamp_lit);
    EXPECT_EQ(status.running, "");
    EXPECT_EQ(status.last, "note");
    EXPECT_FALSE(status.latched);
    {
        const JournalWriter writer(bed.folder() / "journal.jsonl");
        EXPECT_EQ(session_status(bed.folder()).running, std::to_string(getpid()));
    }
    latch_fault(fault_log_of(bed.rig_file()), "the door", 1);
    EXPECT_EQ(session_status(bed.folder()).latched, "the door");
}

// In a supervised process: programs as camera, axes and sample. The white frames that must agree
// are a minute apart, so the plan is stopped before: what is tested is the way to the camera.
TEST(SessionJobs, RunProgramsInASupervisedProcess) {
    SessionBed bed;
    create_quick(bed, kSampleCommand);
    std::atomic<bool> stop{false};
    const Progress progress{
        .report = [&](std::string_view stage,
                      double) { stop = stop || stage.starts_with("white frames"); },
        .stop = &stop};
    EXPECT_THROW(run_session_job(
                     {.folder = bed.folder(), .read = read_picture, .silence = kSilence}, progress),
                 Interrupted);
    const Session session = read_session(bed.folder());
    ASSERT_GE(session.warm_up.size(), 2u);
    EXPECT_EQ(read_file(session.warm_up[0].file), "picture 0.1 200 white-0000.tif end\n");
    EXPECT_EQ(session_status(bed.folder()).lamp_lit, false);
}

// Where nobody can be asked, the session ends before the lamp has burned for nothing.
TEST(SessionJobs, NeedAnOperatorWhereTheRigDoes) {
    SessionBed bed;
    create_quick(bed);
    try {
        run_session_job({.folder = bed.folder(), .read = read_picture, .silence = kSilence});
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].what,
                  "nobody can be asked to put the white standard under the camera");
    }
    std::vector<std::string> asked;
    int answers = 0;
    std::atomic<bool> stop{false};
    EXPECT_THROW(run_session_job(
                     {.folder = bed.folder(),
                      .read = read_picture,
                      .silence = kSilence,
                      .ask = [&](const std::string &what) { asked.push_back(what); },
                      .answered = [&] { return ++answers > 2; }},
                     {.report = [&](std::string_view stage,
                                    double) { stop = stop || stage.starts_with("white frames"); },
                      .stop = &stop}),
                 Interrupted);
    EXPECT_EQ(asked, std::vector<std::string>{"put the white standard under the camera"});
}

// The lamp does not burn for an operator who has gone home.
TEST(SessionJobs, EndWhereTheOperatorDoesNotAnswer) {
    SessionBed bed;
    create_quick(bed, "", 0.3);
    try {
        run_session_job({.folder = bed.folder(),
                         .read = read_picture,
                         .silence = kSilence,
                         .ask = [](const std::string &) {},
                         .answered = [] { return false; }});
        FAIL() << "no error";
    } catch (const Error &error) {
        EXPECT_EQ(error.problems()[0].what, "nobody has answered for the lamp's hold_s");
    }
    EXPECT_FALSE(session_status(bed.folder()).lamp_lit);
}

} // namespace
} // namespace tsuya::lab

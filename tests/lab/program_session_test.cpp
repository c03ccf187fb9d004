// Sessions whose camera, axes and samples are programs, as those of a rig are: what a camera does
// wrong, and what the session makes of it.

#include <csignal>

#include <gtest/gtest.h>

#include "lab/virtual_cloth.h"
#include "samples/scratch.h"
#include "tsuya/lab/cameras.h"
#include "tsuya/lab/frame_reader.h"
#include "tsuya/lab/measure_session.h"
#include "tsuya/lab/planning.h"
#include "tsuya/lab/rig_mechanics.h"
#include "tsuya/lab/session_run.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/file.h"

namespace tsuya::lab {
namespace {

using std::chrono::nanoseconds;

/// Passes over long sleeps; programs run in real time.
class SkippingClock final : public Clock {
  public:
    nanoseconds now() override { return steady_.now() + skipped_; }
    [[nodiscard]] bool sleep_until(nanoseconds deadline, const std::atomic<bool> *stop) override {
        constexpr std::chrono::milliseconds kLong{200};
        if (deadline - now() > kLong)
            skipped_ += deadline - now();
        return steady_.sleep_until(deadline - skipped_, stop);
    }

  private:
    SteadyClock steady_{};
    nanoseconds skipped_{0};
};

/// A line that the program sees.
class StateLine final : public OutputLine {
  public:
    StateLine(const std::filesystem::path &state, std::string name)
        : state_(state), name_(std::move(name)) {
        set(false);
    }
    void set(bool active) override { write_file(state_ / name_, active ? "1" : "0"); }
    const std::string &name() const override { return name_; }

  private:
    std::filesystem::path state_;
    std::string name_;
};

/// Drives that do not stand at 0 with their axes, and of which two turn the other way.
/// \param camera the program, as words of the command
std::string rig_text(const std::filesystem::path &state, const std::string &camera, int timeout_s) {
    const std::string folder = state.string();
    std::string text = "schema = \"tsuya-rig 1\"\n[lamp]\nkind = \"led\"\nwarm_up_s = 1\n"
                       "restrike_s = 0\nmin_on_s = 0\nhold_s = 600\n[camera]\ncommand = [" +
                       camera + ", \"" + folder + "/a.rig.toml\", \"" + folder +
                       "\", \"{file}\", \"{exposure}\"]\ntimeout_s = " + std::to_string(timeout_s) +
                       "\nexposures_s = [1]\n"
                       "black = 512\nsaturation = 15800\ne_per_dn = 2.5\nread_noise_e = 4\n"
                       "pixel_mm = 0.05\n[sample]\ndrive = \"command\"\n"
                       "command = [\"/bin/sh\", \"-c\", \"echo {sample} > " +
                       folder + "/sample\"]\n[white]\nrho_std = 0.99\n";
    const char *const drives[][2] = {{"lamp_theta", "zero_deg = 3\nsign = -1\n"},
                                     {"lamp_phi", "zero_deg = -20\n"},
                                     {"camera", "zero_deg = 1\n"},
                                     {"stage", "zero_deg = 7\nsign = -1\n"}};
    for (const auto &[axis, keys] : drives)
        text += std::string("[axes.") + axis +
                "]\ndrive = \"command\"\ncommand = [\"/bin/sh\", \"-c\", \"echo {deg} > " + folder +
                "/{axis}\"]\nlimits_deg = [-400, 400]\n" + keys;
    return text;
}

/// A rig of programs, and a session on it.
class ProgramSession {
  public:
    explicit ProgramSession(std::vector<double> lights_deg = {0},
                            const std::string &camera = "\"" TSUYA_VIRTUAL_CAMERA "\"",
                            int timeout_s = 6) {
        write_file(rig_file(), rig_text(scratch_.folder(), camera, timeout_s));
        rig_ = read_rig_file(rig_file());
        Directions views;
        for (const double theta_i : lights_deg)
            for (const auto &[theta_r, phi_r] :
                 {std::pair{20.0, 30.0}, std::pair{50.0, 100.0}, std::pair{60.0, 250.0}})
                views.pairs.push_back(
                    {theta_i * kDegree, 2 * theta_i * kDegree, theta_r * kDegree, phi_r * kDegree});
        const std::filesystem::path plan = scratch_ / "a.plan.jsonl";
        write_plan(make_plan(rig_, {.directions = views, .rig = rig_file()}), plan);
        create_session(folder(), plan, rig_file());
    }
    /// \param faults lines `N FAULT`, N counted over all runs
    SessionResult run(const std::string &faults) {
        write_file(scratch_ / "faults", faults);
        SkippingClock time;
        SafetyClock clock(time, nullptr, nullptr);
        StateLine lamp(scratch_.folder(), "lamp"), shutter(scratch_.folder(), "shutter");
        RigMechanics mechanics(rig_, clock, {}, {});
        CommandCamera camera(rig_.camera, clock, {});
        const double epoch_s = 1.7e9 + 1e5 * runs_++;
        return run_session(folder(), rig_,
                           {.lamp = &lamp,
                            .shutter = &shutter,
                            .mechanics = mechanics,
                            .camera = camera,
                            .clock = clock,
                            .read = read_frame_facts,
                            .moments =
                                [&] {
                                    return Moment{"boot", 0, epoch_s + Seconds(time.now()).count()};
                                }},
                           {});
    }
    std::filesystem::path folder() const { return scratch_ / "session"; }
    std::filesystem::path rig_file() const { return scratch_ / "a.rig.toml"; }
    std::string state(const char *name) const { return read_file(scratch_ / name); }
    Session session() const { return read_session(folder()); }

  private:
    scene::Scratch scratch_{};
    RigFile rig_{};
    int runs_ = 0;
};

std::vector<std::string> pictures_of(const Session &session) {
    std::vector<std::string> pictures;
    for (const CountedFrame &frame : session.frames)
        pictures.push_back(read_file(frame.file));
    return pictures;
}

// The camera knows nothing but where the drives stand and what the lines do.
TEST(ProgramSession, MeasuresTheClothThatTheProgramSees) {
    ProgramSession made({0, 30});
    ASSERT_EQ(made.run("").missing(), 0u);
    EXPECT_EQ(made.state("lamp"), "0");
    EXPECT_EQ(made.state("shutter"), "0");
    const SessionMeasurement measured =
        measure_session(made.session(), {.repeat_mm = {{0.4, 0.4}}});
    ASSERT_EQ(measured.channels[0].views.size(), 6u);
    for (const MeasuredView &view : measured.channels[0].views)
        EXPECT_NEAR(view.brdf_per_sr / test::virtual_cloth(view.directions), 1, 0.005);
}

// The pictures are on a card, from which gphoto2 downloads them. A camera that did not expose has
// nothing to be downloaded.
TEST(ProgramSession, TakesWhatGphoto2Downloads) {
    if (std::system("command -v gphoto2 >/dev/null") != 0)
        GTEST_SKIP() << "no gphoto2 (samples/install-packages test)";
    constexpr int kTimeout_s = 60; // three programs one after the other
    ProgramSession made({0}, "\"" TSUYA_GPHOTO2_CAMERA "\", \"" TSUYA_VIRTUAL_CAMERA "\"",
                        kTimeout_s);
    ASSERT_EQ(made.run("1 no_file\n").missing(), 0u);
    const Session session = made.session();
    for (const CountedFrame &frame : session.frames)
        EXPECT_EQ(read_file(frame.file), made.state(("card" / frame.file.filename()).c_str()));
    ASSERT_EQ(session.rejected.size(), 1u);
    EXPECT_NE(session.rejected[0].why.find("gphoto2 does not list"), std::string::npos);
}

struct FaultCase {
    const char *faults;
    const char *why; ///< in the journal
    int rejected;    ///< how often
    bool has_file;   ///< the rejected picture is kept
};

// The first exposures tell whether the lamp is warm; those of the plan follow.
TEST(ProgramSession, SurvivesEveryFaultOfACamera) {
    ProgramSession good;
    ASSERT_EQ(good.run("").missing(), 0u);
    const std::size_t warm_up = good.session().warm_up.size();
    const auto at = [&](int n) { return std::to_string(warm_up + static_cast<std::size_t>(n)); };
    const FaultCase cases[] = {
        {"busy", "returned status 1: virtual camera: the camera is busy", 2, false},
        {"hang", "the program was killed: it was not done in time", 1, false},
        {"no_file", "no picture came", 1, false},
        {"empty_file", "the picture is empty", 1, true},
        {"cut_file", "cannot read the picture", 1, true},
        {"old_file", "the picture is a copy of an earlier one", 1, true},
        {"wrong_exposure", "the picture was exposed for 0.5 s", 1, true}};
    std::string faults;
    int n = 0;
    for (const FaultCase &fault : cases) { // each on a frame of its own
        for (int i = 0; i < fault.rejected; ++i)
            faults += at(n++) + " " + fault.faults + "\n";
        ++n;
    }
    ProgramSession bad;
    ASSERT_EQ(bad.run(faults).missing(), 0u);
    const Session session = bad.session();
    std::size_t i = 0;
    for (const FaultCase &fault : cases)
        for (int k = 0; k < fault.rejected; ++k, ++i) {
            ASSERT_LT(i, session.rejected.size()) << fault.faults;
            const RejectedFrame &rejected = session.rejected[i];
            EXPECT_NE(rejected.why.find(fault.why), std::string::npos)
                << fault.faults << ": " << rejected.why;
            EXPECT_EQ(!rejected.file.empty(), fault.has_file) << fault.faults;
            EXPECT_EQ(std::filesystem::exists(rejected.file), fault.has_file) << fault.faults;
        }
    EXPECT_EQ(i, session.rejected.size());
    EXPECT_EQ(kill(std::atoi(bad.state("hangs").c_str()), 0), -1) << "the program that hung";
    EXPECT_EQ(pictures_of(session), pictures_of(good.session()));
}

TEST(ProgramSession, GoesOnWithoutAFrameThatFailsAlwaysAndTakesItLater) {
    ProgramSession made;
    ASSERT_EQ(made.run("5 no_file\n6 no_file\n7 no_file\n").missing(), 1u);
    Session session = made.session();
    ASSERT_EQ(session.missing.size(), 1u);
    EXPECT_EQ(session.rejected.size(), 3u);
    EXPECT_EQ(made.run("").missing(), 0u);
    EXPECT_EQ(made.session().rejected.size(), 3u);
}

} // namespace
} // namespace tsuya::lab

// Sessions that are disturbed at random: whatever happens, the lamp is off, each frame counts once,
// and the pictures that count are those of an undisturbed session.
#include "lab/session_bed.h"
#include "limited_disk.h"

#include <gtest/gtest.h>

#include <random>

#include <sys/wait.h>

namespace tsuya::lab {
namespace {

enum class Fault { none, drop, delay, kill, kill_after_picture, stop, housing, full_disk };
constexpr int kFaults = 8;

constexpr int kStillOn = 64, kKilled = 9; // of a child's exit status

/// What happens to one run of the program, and at which of its steps.
struct Schedule {
    Fault fault = Fault::none;
    int at_step = 0;
    int amount = 0; ///< how long a delay is, in seconds; how many bytes the journal has left
};

Schedule random_schedule(std::mt19937 &random) {
    const auto below = [&](int n) { return std::uniform_int_distribution<int>(0, n - 1)(random); };
    return {.fault = static_cast<Fault>(below(kFaults)),
            .at_step = below(60),
            .amount = 1 + below(700)};
}

/// Disturbs a run at one of its steps: movements, exposures, pictures.
class Disturber {
  public:
    Disturber(BedRun &run, const Schedule &schedule) : run_(run), schedule_(schedule) {
        run.mechanics.on_move = [this](AxisName) { step(); };
        run.camera.on_expose = [this](const Shot &) { step(); };
        run.camera.on_collect = [this](const Shot &shot) { return picture(shot); };
    }

  private:
    bool now() { return steps_++ == schedule_.at_step; }
    void step() {
        if (!now())
            return;
        switch (schedule_.fault) {
        case Fault::drop:
            throw Error({"no answer", "bed", ""});
        case Fault::delay:
            run_.time.advance(std::chrono::seconds(schedule_.amount));
            break;
        case Fault::kill:
        case Fault::kill_after_picture:
            _exit(kKilled);
        case Fault::stop:
            run_.stop = true;
            break;
        case Fault::housing:
            run_.interlock.change(false);
            break;
        case Fault::none:
        case Fault::full_disk:
            break;
        }
    }
    bool picture(const Shot &shot) {
        if (!now())
            return false;
        if (schedule_.fault == Fault::kill_after_picture) {
            write_file(shot.file, run_.camera.picture_of(shot));
            _exit(kKilled);
        }
        return schedule_.fault == Fault::drop; // no picture comes
    }

    BedRun &run_;
    const Schedule &schedule_;
    int steps_ = 0;
};

/// In a process of its own, as the program is. \return its exit status
int run_in_child(const SessionBed &bed, const SessionSettings &settings, const Schedule &schedule,
                 double epoch_s) {
    const std::filesystem::path journal = bed.folder() / "journal.jsonl";
    const auto length = std::filesystem::exists(journal) ? std::filesystem::file_size(journal) : 0;
    const pid_t child = fork();
    if (child == 0) {
        std::optional<test::FileSizeLimit> disk;
        if (schedule.fault == Fault::full_disk)
            disk.emplace(length + static_cast<rlim_t>(schedule.amount) + 500);
        BedRun run(bed.rig, epoch_s);
        run.boottime_s = epoch_s;
        const Disturber disturber(run, schedule);
        int status = 0;
        try {
            run.run(bed.folder(), bed.rig, settings);
        } catch (const Interrupted &) {
            status = 3;
        } catch (const Error &) {
            status = 1;
        }
        _exit(status + (run.lamp.active() || run.shutter.active() ? kStillOn : 0));
    }
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A power cut may leave part of the last line alone.
void tear_last_line(const std::filesystem::path &journal, std::mt19937 &random) {
    const std::string text = read_file(journal);
    if (text.empty())
        return;
    const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
    std::uniform_int_distribution<std::size_t> cut(last, text.size());
    write_file(journal, text.substr(0, cut(random)));
}

class FaultSchedules : public testing::Test {
  protected:
    std::vector<std::string> good = pictures_of(SessionBed().finished());
};

TEST_F(FaultSchedules, LoseNoFrameAndCountNoneTwice) {
    std::array<int, kFaults> met{};
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::mt19937 random(seed);
        const SessionBed bed;
        bed.create();
        const SessionSettings settings{.lamp_log = bed.scratch / "lamp.log",
                                       .fault_log = bed.scratch / "faults.jsonl",
                                       .wait = true};
        double epoch_s = 1.7e9;
        bool finished = false;
        for (int i = 0; i < 12 && !finished; ++i, epoch_s += 1e5) {
            const Schedule schedule = i < 8 ? random_schedule(random) : Schedule{};
            ++met[static_cast<std::size_t>(schedule.fault)];
            const int status = run_in_child(bed, settings, schedule, epoch_s);
            ASSERT_TRUE(status == 0 || status == 1 || status == 3 || status == kKilled)
                << "seed " << seed << ", run " << i << ": status " << status;
            if (status == kKilled)
                tear_last_line(bed.folder() / "journal.jsonl", random);
            if (latched_fault(settings.fault_log))
                acknowledge_fault(settings.fault_log, "closed", epoch_s);
            finished = read_session(bed.folder()).missing.empty();
        }
        ASSERT_TRUE(finished) << "seed " << seed;
        const Session session = read_session(bed.folder());
        EXPECT_EQ(pictures_of(session), good) << "seed " << seed;
        std::map<std::size_t, int> counts;
        for (const JournalEvent &event : read_journal(bed.folder() / "journal.jsonl").events)
            if (event.kind == EventKind::ok && event.frame)
                ++counts[*event.frame];
        for (std::size_t number = 0; number < session.plan.frames.size(); ++number)
            EXPECT_EQ(counts[number], 1) << "seed " << seed << ", frame " << number;
    }
    for (int i = 0; i < kFaults; ++i)
        EXPECT_GE(met[static_cast<std::size_t>(i)], 25) << "fault " << i;
}

} // namespace
} // namespace tsuya::lab

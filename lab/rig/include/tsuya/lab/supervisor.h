#pragma once
/// \file
/// Lines that are driven off from outside when the work with them hangs or dies.

#include "tsuya/lab/clock.h"
#include "tsuya/lab/line.h"
#include "tsuya/sdk/progress.h"

#include <functional>
#include <string_view>
#include <vector>

namespace tsuya::lab {

namespace detail {
class WorkerPipes;
}

/// What is supervised, and how.
struct Supervision {
    /// In the order in which they are driven off: the lamp first, then the shutter. Null entries
    /// are ignored.
    std::vector<OutputLine *> lines{};
    /// The work counts as hanging when it has not beaten for so long; 100 ms to 5 s.
    std::chrono::milliseconds silence{200};
    /// The same while it does anything but wait on its clock, such as to read a large picture or to
    /// store on a slow disk; `silence` to 5 s. 0: `silence`.
    std::chrono::milliseconds silence_at_work{0};
    /// A line that is toggled with each beat, for a relay that cuts the lamp when it stands still.
    OutputLine *heartbeat = nullptr;
    /// Called in the calling process with what the work has sent, in order; may be empty. What was
    /// sent after a stop is dropped: the lines were driven off under the work.
    std::function<void(std::string_view message)> receive{};
    /// Other threads that the program may have: those that libraries started before `main`, which
    /// sleep and hold no lock. The work does not have them.
    int library_threads = 0;
};

/// The threads of this program beside the caller's. At the start of `main`: those of libraries.
int other_threads();

/// The working process's side.
class Worker {
  public:
    static constexpr std::chrono::milliseconds kBeat{50}; ///< at most between two beats

    /// Made by run_supervised.
    explicit Worker(detail::WorkerPipes &pipes);

    /// The computer's monotonic clock, whose sleeps beat. Sleep with no other.
    Clock &clock() { return clock_; }
    /// Says that the work goes on. Call it at least each kBeat where the work does not sleep.
    void beat();
    /// Sends a message of at most kMaxMessage bytes to the calling process.
    void send(std::string_view message);
    static constexpr std::size_t kMaxMessage = 2048;
    /// Says which process group a command of the work runs in, to be killed with the work; 0: none.
    void command_group(int group);
    /// Reports to the caller's progress; its stop flag is set when the caller's is, or when the
    /// calling process is gone.
    Progress progress();

  private:
    class BeatingClock final : public Clock {
      public:
        explicit BeatingClock(Worker &worker) : worker_(worker) {}
        std::chrono::nanoseconds now() override { return steady_.now(); }
        [[nodiscard]] bool sleep_until(std::chrono::nanoseconds deadline,
                                       const std::atomic<bool> *stop) override;
        void wait_more(bool begins) override;

      private:
        Worker &worker_;
        int waits_ = 0; ///< blocks of Waiting, one in another
        SteadyClock steady_;
    };

    detail::WorkerPipes &pipes_;
    BeatingClock clock_{*this};
    std::atomic<bool> stop_{false};
    std::chrono::nanoseconds last_beat_{-kBeat};
};

/// Runs `work` in a child process that shares the lines, and watches it. When it is silent, ends,
/// or `progress.stop` is set, the lines are driven off at once; then the process groups of the
/// child and of its command are killed (after a stop it has kStopGrace to end by itself, with its
/// lines held off), and the lines are driven off once more, since the child could have set them in
/// between. A line whose device is gone ends the work within a second. If the calling process is
/// killed, the work stops by itself.
///
/// Take the lines before the call. The child's other changes to memory are lost: what the caller is
/// to know goes through Worker::send. `progress.report` is called in the calling process and must
/// not block: see ProgressRelay. Call it before the program starts a thread, as a fork copies only
/// the thread that calls it.
///
/// Throws what `work` threw: Error with its problems, Interrupted, other exceptions as Error.
/// Throws Error if there is another thread, the silence is out of range, the work hung or was
/// killed, a line is gone, or one may still be on.
void run_supervised(const Supervision &supervision, const std::function<void(Worker &)> &work,
                    const Progress &progress = {});

/// How long work that is asked to stop may take before it is killed.
inline constexpr std::chrono::milliseconds kStopGrace{1000};

} // namespace tsuya::lab

#pragma once
/// \file
/// What a supervised process and its supervisor say to each other.

#include <string>
#include <string_view>

namespace tsuya::lab::detail {

/// What a frame says.
enum class FrameKind : char {
    beat,
    waits,       ///< one byte: whether the work waits on its clock from now on
    progress,    ///< fraction as double, then the stage
    message,     ///< of Worker::send
    group,       ///< the process group of a command that runs, an int; 0: none does
    problem,     ///< what, where, accepted, each ended by a zero byte
    failed,      ///< the last frame of work that threw; after its problems
    interrupted, ///< the last frame of work that was stopped, with why
    done,        ///< the last frame of work that returned
};

struct Frame {
    FrameKind kind;
    std::string payload;
};

/// Two pipes: frames from the worker, and one byte to it that asks it to stop. No executed command
/// inherits them.
class WorkerPipes {
  public:
    /// Longest payload: a frame is written whole or not at all, as pipes promise up to PIPE_BUF.
    static constexpr std::size_t kMaxPayload = 4000;

    /// Throws Error if the system has no pipes left.
    WorkerPipes();
    ~WorkerPipes();
    WorkerPipes(const WorkerPipes &) = delete;
    WorkerPipes &operator=(const WorkerPipes &) = delete;

    /// After the fork: closes the ends of the other process.
    void become_worker();
    void become_supervisor();

    /// The worker's. A frame that must not be lost waits until there is room.
    void write(FrameKind kind, std::string_view payload, bool may_be_lost);
    /// Whether the supervisor asked to stop, or is gone.
    bool stop_asked();

    /// The supervisor's.
    void ask_to_stop();
    /// Waits for frames as long as told, at most; a signal ends the wait. \return false at the end
    /// of the pipe
    bool wait_and_read(int timeout_ms);
    /// The next frame that was read, if there is one.
    bool next(Frame &frame);

  private:
    static void close_end(int &end);

    int from_worker_[2] = {-1, -1};
    int to_worker_[2] = {-1, -1};
    std::string buffer_{};
};

} // namespace tsuya::lab::detail

#pragma once
/// \file
/// Progress that never holds up the thread that reports it.

#include "tsuya/sdk/progress.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <thread>

namespace tsuya::lab {

/// Hands reports to another thread through a bounded queue, so that a paused terminal or a dead
/// pipe cannot hold a lit lamp. When the queue is full the oldest report is dropped.
class ProgressRelay {
  public:
    static constexpr std::size_t kCapacity = 64; ///< reports in the queue

    /// \param receiver called on the other thread, which starts with the first report. What it
    ///                 throws ends the reporting.
    explicit ProgressRelay(Progress receiver) : receiver_(std::move(receiver)) {}
    ProgressRelay(const ProgressRelay &) = delete;
    ProgressRelay &operator=(const ProgressRelay &) = delete;
    /// Waits until everything in the queue was reported, as long as the receiver may block.
    ~ProgressRelay();

    /// Reports into the queue; with the receiver's stop flag. The relay must outlive it.
    Progress progress();

  private:
    struct Report {
        std::string stage;
        double fraction;
    };

    void push(std::string_view stage, double fraction);
    void deliver();

    Progress receiver_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Report> queue_;
    bool ending_ = false;
    std::thread thread_;
};

} // namespace tsuya::lab

#include "tsuya/lab/progress_relay.h"

namespace tsuya::lab {

ProgressRelay::~ProgressRelay() {
    {
        const std::lock_guard lock(mutex_);
        ending_ = true;
    }
    changed_.notify_one();
    if (thread_.joinable())
        thread_.join();
}

Progress ProgressRelay::progress() {
    Progress progress{.stop = receiver_.stop};
    if (receiver_.report)
        progress.report = [this](std::string_view stage, double fraction) {
            push(stage, fraction);
        };
    return progress;
}

void ProgressRelay::push(std::string_view stage, double fraction) {
    {
        const std::lock_guard lock(mutex_);
        if (queue_.size() >= kCapacity)
            queue_.pop_front();
        queue_.push_back({std::string(stage), fraction});
    }
    changed_.notify_one();
    if (!thread_.joinable())
        thread_ = std::thread([this] { deliver(); });
}

void ProgressRelay::deliver() {
    try {
        for (std::unique_lock lock(mutex_);;) {
            changed_.wait(lock, [this] { return ending_ || !queue_.empty(); });
            if (queue_.empty())
                return;
            const Report report = std::move(queue_.front());
            queue_.pop_front();
            lock.unlock();
            receiver_(report.stage, report.fraction);
            lock.lock();
        }
    } catch (...) { // the receiver's own; there is nobody to tell
    }
}

} // namespace tsuya::lab

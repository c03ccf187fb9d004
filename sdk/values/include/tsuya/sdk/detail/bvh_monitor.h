#pragma once
/// \file
/// Building a BVH of Embree so that it can be stopped, in layers that trace with it.

#include <mutex>
#include <string>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::detail {

/// Embree asks it while it builds, from all of its threads. No header of Embree is needed here.
class BvhMonitor {
  public:
    explicit BvhMonitor(const Progress &progress) : progress_(progress) {}

    /// An RTCProgressMonitorFunction: reports how far the build is as the stage "prepare".
    /// \param monitor a BvhMonitor
    /// \return whether to go on
    static bool ask(void *monitor, double fraction) {
        BvhMonitor &m = *static_cast<BvhMonitor *>(monitor);
        if (const std::unique_lock lock(m.reporting_, std::try_to_lock); lock)
            m.progress_("prepare", fraction);
        return !m.progress_.stopped();
    }

    /// Throws Interrupted where the build was stopped, Error where it failed.
    /// \param error an RTCError
    void check(int error) const {
        if (progress_.stopped())
            throw Interrupted("stopped while the BVH was built");
        if (error != 0)
            throw Error({"Embree cannot build the BVH (error " + std::to_string(error) + ")", "",
                         "expected enough memory for the scene"});
    }

  private:
    const Progress &progress_;
    std::mutex reporting_{};
};

} // namespace tsuya::detail

#pragma once
/// \file
/// Work in a process of its own.

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// What the work may take.
struct ChildLimits {
    std::uint64_t memory_bytes = 0; ///< beyond what the caller has already
    std::chrono::seconds cpu_time{};
    std::chrono::milliseconds wall_time{}; ///< for work that waits and takes no processor time
    std::uint64_t result_bytes = 0;
};

/// How the work ended.
struct ChildResult {
    enum class End {
        done,
        failed,
        out_of_cpu_time,
        out_of_wall_time,
        out_of_memory,
        too_long, ///< the result
        killed    ///< by another process, or by the system when its memory is used up
    } end = End::failed;
    std::string bytes{}; ///< done: what the work returned; failed: why, or empty after a crash
};

/// Does the work in a copy of this process (fork), whose memory, open files and threads it cannot
/// change; what it writes to the standard streams is lost. An exception of the work is a failure;
/// so is a crash. The copy ends with this process, too, also where this one is killed.
/// \param work must not wait for other threads: the copy has none
/// Throws Error naming `where` where no process can be made, Interrupted where `progress` says
/// stop, after the process has ended.
ChildResult run_in_child(const std::function<std::string()> &work, const ChildLimits &limits,
                         const std::string &where, const Progress &progress);

} // namespace tsuya::garment

#pragma once
/// \file
/// Long loops look at the caller's stop flag.

#include <cstddef>

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

namespace tsuya::garment {

/// Throws Interrupted where the caller asked to stop.
inline void look_at_stop(const Progress &progress) {
    if (progress.stopped())
        throw Interrupted("stopped while preparing a mesh");
}

/// The same for loops, at one turn in many. \param turn counts up by 1
inline void look_at_stop(const Progress &progress, std::size_t turn) {
    constexpr std::size_t kStride = 4096;
    if (turn % kStride == 0)
        look_at_stop(progress);
}

/// Reports the start of a stage, then looks at the flag.
inline void begin_stage(const Progress &progress, const char *stage) {
    progress(stage, 0.0);
    look_at_stop(progress);
}

} // namespace tsuya::garment

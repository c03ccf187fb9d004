#pragma once
// How the making of tables is stopped.

#include "tsuya/sdk/error.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

// Throws Interrupted where the caller asked to stop.
inline void stop_if_asked(const Progress &progress) {
    if (progress.stopped())
        throw Interrupted("stopped while the tables of a reflectance model were made");
}

} // namespace tsuya

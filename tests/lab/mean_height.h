#pragma once
// Where the yarns of a weave lie, for the tests of its geometry.

#include "tsuya/lab/filaments.h"

namespace tsuya::lab {

/// Mean height of a yarn's filaments at a crossing: index of its points there.
inline double mean_height(const FilamentRepeat &repeat, std::uint32_t system, int yarn, int place) {
    double sum = 0;
    int count = 0;
    for (const Filament &f : repeat.filaments)
        if (f.system == system && f.yarn == static_cast<std::uint32_t>(yarn)) {
            sum += f.point[static_cast<std::size_t>(place)].z;
            ++count;
        }
    return sum / count;
}

} // namespace tsuya::lab

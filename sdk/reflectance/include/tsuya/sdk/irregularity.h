#pragma once
/// \file
/// What no two yarns of a cloth have alike.

#include <cstdint>
#include <string>

namespace tsuya {

/// How uneven yarns are. It moves what a cloth reflects from place to place; the mean over the
/// cloth stays as it is.
struct Irregularity {
    double thickness = 0; ///< standard deviation of a yarn's width over its mean, 0 to 0.3
    /// Standard deviation of a filament's slope from that of its yarn, radians, 0 to 0.3
    double filament = 0.02;
    double slubs_per_m = 0;    ///< thick places of a weft yarn in a metre of it, 0 to 100
    double slub_length = 0.02; ///< of one, metres, 0.001 to 1; at most 1 / slubs_per_m
    double slub_gain = 1;      ///< how much wider its middle is: 1 is twice as wide; 0 to 5
    std::int64_t seed = 1;     ///< of the random numbers, 0 to 1e9

    bool operator==(const Irregularity &) const = default;
};

/// Throws Error naming `where` and the member that is out of its range.
void check_irregularity(const Irregularity &irregularity, const std::string &where);

} // namespace tsuya

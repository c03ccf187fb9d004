#pragma once
// What the yarns of a face hide from each other.

#include <vector>

#include "tsuya/sdk/weave_map.h"

namespace tsuya {

// The share of an even sky that each place of a map sees past the yarns about it, by the cosine:
// the mean over azimuths of cos^2 of the horizon's elevation. 0 in gaps.
std::vector<float> sky_shares(const WeaveMap &map);

} // namespace tsuya

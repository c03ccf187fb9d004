#include "tsuya/sdk/weave_map.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

bool is_sound(const WeavePlace &place, const WeaveMap &map) {
    if (place.system == WeavePlace::kGap)
        return true;
    if (place.system > WeavePlace::kGap)
        return false;
    const int threads = place.system == WeavePlace::kWarp ? map.threads.x : map.threads.y;
    return place.thread < threads && std::abs(place.slope) < 1.6f && place.along >= 0 &&
           place.along <= 1 && std::abs(place.across) <= 1 && std::isfinite(place.height);
}

} // namespace

double WeaveMap::share(std::uint8_t system) const {
    const auto count = std::count_if(place.begin(), place.end(),
                                     [&](const WeavePlace &p) { return p.system == system; });
    return place.empty() ? 0 : static_cast<double>(count) / static_cast<double>(place.size());
}

void check_weave_map(const WeaveMap &map, const std::string &where) {
    Problems problems;
    problems.need(map.repeat.x > 0 && map.repeat.y > 0 && std::isfinite(map.repeat.x) &&
                      std::isfinite(map.repeat.y),
                  "the repeat has no area", where + ".repeat", "expected metres above 0");
    problems.need(map.threads.x > 0 && map.threads.y > 0, "the repeat has no threads",
                  where + ".threads", "expected at least one each way");
    problems.need(map.filaments.x > 0 && map.filaments.y > 0, "a yarn has no filament",
                  where + ".filaments", "expected at least one");
    const bool sized = map.size[0] > 0 && map.size[1] > 0 &&
                       map.place.size() == static_cast<std::size_t>(map.size[0]) *
                                               static_cast<std::size_t>(map.size[1]);
    problems.need(sized, "the map has " + std::to_string(map.place.size()) + " places",
                  where + ".place", "expected as many as `size` says");
    for (std::size_t i = 0; i < map.place.size(); ++i)
        if (!problems.need(is_sound(map.place[i], map),
                           "place " + std::to_string(i) + " is out of range", where + ".place",
                           "expected what weave_map.h says of a place"))
            break;
    problems.throw_if_any();
}

} // namespace tsuya

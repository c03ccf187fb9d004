#include "crowded_places.h"

#include <algorithm>
#include <numeric>

namespace tsuya::lab {
namespace {

using Numbers = std::vector<std::size_t>;

/// Takes the first of `rest` and all that steps lead to from there.
Numbers take_joined(const std::vector<glm::dvec2> &places, double step, Numbers &rest) {
    Numbers joined{rest.front()};
    rest.erase(rest.begin());
    for (std::size_t reached = 0; reached < joined.size(); ++reached) {
        const glm::dvec2 here = places[joined[reached]];
        const auto near = std::stable_partition(rest.begin(), rest.end(), [&](std::size_t other) {
            return glm::distance(here, places[other]) >= step;
        });
        joined.insert(joined.end(), near, rest.end());
        rest.erase(near, rest.end());
    }
    return joined;
}

bool any_overlap(const std::vector<glm::dvec2> &places, double overlap, const Numbers &crowd) {
    for (std::size_t i = 0; i < crowd.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (glm::distance(places[crowd[i]], places[crowd[j]]) < overlap)
                return true;
    return false;
}

} // namespace

Crowds sort_out_crowds(const std::vector<glm::dvec2> &places, double overlap, double step) {
    Numbers rest(places.size());
    std::iota(rest.begin(), rest.end(), 0);
    Crowds sorted;
    while (!rest.empty()) {
        Numbers joined = take_joined(places, step, rest);
        if (any_overlap(places, overlap, joined))
            sorted.crowds.push_back(std::move(joined));
        else
            sorted.alone.insert(sorted.alone.end(), joined.begin(), joined.end());
    }
    return sorted;
}

} // namespace tsuya::lab

#include "tsuya/lab/filaments.h"

#include <cmath>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya::lab {
namespace {

bool finite(const glm::vec3 &v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

void check_repeat(const FilamentRepeat &repeat, const std::string &where) {
    const auto fail = [&](std::string what, std::string accepted) {
        throw Error({std::move(what), where, std::move(accepted)});
    };
    if (!(repeat.size.x > 0 && repeat.size.y > 0) || !std::isfinite(repeat.size.x + repeat.size.y))
        fail("the repeat has no area", "expected a size above 0 in metres");
    if (repeat.filaments.empty())
        fail("the repeat has no filament", "expected at least one");
    const glm::dvec2 reach = 2.0 * repeat.size;
    for (std::size_t i = 0; i < repeat.filaments.size(); ++i) {
        const Filament &f = repeat.filaments[i];
        const std::string name = "filament " + std::to_string(i);
        if (f.system >= repeat.optics.size())
            fail(name + " is of system " + std::to_string(f.system),
                 "expected an index below " + std::to_string(repeat.optics.size()));
        if (!(f.radius > 0) || !std::isfinite(f.radius))
            fail(name + " has no radius", "expected a radius above 0 in metres");
        if (f.point.size() < 2 || (!f.turn.empty() && f.turn.size() != f.point.size()))
            fail(name + " has " + tsuya::detail::counted(f.point.size(), "point") + " and " +
                     tsuya::detail::counted(f.turn.size(), "turn"),
                 "expected at least 2 points, and a turn for each or none");
        for (const glm::vec3 &p : f.point)
            if (!finite(p) || std::abs(p.x) > reach.x || std::abs(p.y) > reach.y)
                fail(name + " strays from the repeat", "expected points within two repeats");
    }
}

} // namespace tsuya::lab

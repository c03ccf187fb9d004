#include "tsuya/sdk/lustre.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

// Of cloth that is all but black, and that has no dye
struct Ends {
    double dark, pale;
};
constexpr std::array<Ends, kLustreNames.size()> kEnds = {{{0.04, 0.55}, {0.46, 0.84}, {0.96, 1}}};
constexpr double kPaleness = 0.2; // reflectance in which the share comes to 1/e of its way

} // namespace

Lustre lustre_named(const std::string &name, const std::string &where) {
    const auto found = std::find(kLustreNames.begin(), kLustreNames.end(), name);
    if (found == kLustreNames.end())
        throw Error({"unknown lustre '" + name + "'", where,
                     accepted_names(name, std::vector<std::string>(kLustreNames.begin(),
                                                                   kLustreNames.end()))});
    return static_cast<Lustre>(found - kLustreNames.begin());
}

double delustre_of(Lustre lustre, double reflectance) {
    const Ends &ends = kEnds[static_cast<std::size_t>(lustre)];
    return ends.pale - (ends.pale - ends.dark) * std::exp(-reflectance / kPaleness);
}

} // namespace tsuya

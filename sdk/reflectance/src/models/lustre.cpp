#include "tsuya/sdk/lustre.h"

#include <cmath>
#include <cstddef>

namespace tsuya {
namespace {

// Of cloth that is all but black, and that has no dye
struct Ends {
    double dark, pale;
};
constexpr std::array<Ends, kLustreNames.size()> kEnds = {{{0.04, 0.55}, {0.46, 0.84}, {0.96, 1}}};
constexpr double kPaleness = 0.2; // reflectance in which the share comes to 1/e of its way

} // namespace

double delustre_of(Lustre lustre, double reflectance) {
    const Ends &ends = kEnds[static_cast<std::size_t>(lustre)];
    return ends.pale - (ends.pale - ends.dark) * std::exp(-reflectance / kPaleness);
}

} // namespace tsuya

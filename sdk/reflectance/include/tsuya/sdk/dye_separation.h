#pragma once
/// \file
/// Separates the dye of a cloth from the reflectance of its surface, by a table with several
/// channels.
///
///     const DyedCloth cloth = separate_dye(read_reflectance_file("crimson.csv"), "crimson.csv");
///     fabric.specular = CarriedViews{.bard = Bard::fit(cloth.surface, "crimson.csv")};

#include <optional>
#include <string>
#include <vector>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_file.h"

namespace tsuya {

/// A dyed cloth as the sum of its surface and the body below.
struct DyedCloth {
    /// What all channels have in common, under light from straight above: that of the black cloth.
    ReflectanceTable surface{};
    /// Of the body in each channel, 0 to 1, as FabricColours::dye has it: what it reflects of light
    /// from straight above, without the surface's part. A spectrophotometer shows about the same
    /// (d/8, specular excluded).
    std::vector<double> reflectance{};
};

/// Separates the rows with light from straight above.
///
/// How much more one channel reflects than another, over the hemisphere, is the body's alone. What
/// all have in common is the surface's and the body's: as much of it is the body's as leaves 9 of
/// 10 views a surface that is not negative. The body is taken for a diffuser below the surface,
/// which renders have with a delustre of 1 alone. So what the surface reflects evenly counts as the
/// body's; of black satins, linings and taffetas that is 0.001 to 0.005 in reflectance. A view that
/// leaves the surface less than a 500th of its peak has that. Throws Error naming `where` as
/// Bard::fit and for a body that reflects more than it receives; Interrupted where progress asks to
/// stop. \param f0 of the fibres, as in CarriedViews
DyedCloth separate_dye(const ReflectanceFile &file, const std::string &where,
                       std::optional<double> f0 = {}, const Progress &progress = {});

} // namespace tsuya

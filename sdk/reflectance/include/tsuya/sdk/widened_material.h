#pragma once
/// \file
/// The material that light meets after it was scattered diffusely, in pictures that are looked at.
///
/// A path that leaves a cloth diffusely and then meets a narrow lobe finds a lamp in it seldom and
/// bright: a speck. With wider lobes it finds the lamp more often and less bright; the light is
/// nearly the same after the diffuse scattering. [Kaplanyan] widens the lobes of paths that no
/// other way finds.

#include <optional>

#include "tsuya/sdk/fabric.h"
#include "tsuya/sdk/progress.h"

namespace tsuya {

/// The material with wider lobes and the same colours.
///
/// | lobe | widened to at least |
/// |---|---|
/// | facets of GGX | alpha of 0.3 along both axes |
/// | coloured part that follows the yarns | slopes blurred by 0.2 radians; it reflects as much |
/// | surface of yarns, and what is carried from views | as it is: at most a twentieth of the light,
/// so dim that it makes no specks |
///
/// Empty where nothing is widened. Throws Interrupted where progress asks to stop.
std::optional<Material> widened(const Material &material, const Progress &progress = {});
/// The same with the tables of the material's specular part, as resolve (fabric.h).
std::optional<Material> widened(const Material &material, ModelTables &tables,
                                const Progress &progress = {});

} // namespace tsuya

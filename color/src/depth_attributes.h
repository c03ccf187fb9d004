#pragma once
/// \file
/// Depths of dye as attributes of a picture file:
///
///     tsuya:basis           depths COUNT
///     tsuya:dye.0           name of the dye
///     tsuya:dye.0.range     LOWEST HIGHEST open|fixed
///     tsuya:dye.0.spectrum  of the dye that is shown: NM VALUE NM VALUE ...
///     tsuya:depth.3         of channel 3, for each dye: REFLECTANCE DEGREE

#include <map>
#include <optional>
#include <string>

#include "tsuya/sdk/dye_depths.h"

namespace tsuya {

void write_depths(const DyeDepths &depths, std::map<std::string, std::string> &attributes);

/// Empty where the channels are something else. Throws Error at `where` for attributes that are
/// missing or wrong.
std::optional<DyeDepths> read_depths(const std::map<std::string, std::string> &attributes,
                                     const std::string &where);

} // namespace tsuya

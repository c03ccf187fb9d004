#pragma once
/// \file
/// `--grain`: where the warp runs on a mesh that has no UV.

#include <optional>
#include <string>

#include "options.h"

namespace tsuya::program {

/// `--grain`
void add_grain(Options &options, std::string &grain);

/// Radians counter-clockwise from the vertical, of `vertical`, `horizontal` or degrees; nullopt for
/// an empty text. Throws Error for anything else.
std::optional<double> parse_grain(const std::string &text);

} // namespace tsuya::program

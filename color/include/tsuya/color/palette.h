#pragma once
/// \file
/// Palettes: all spectra of a file at once.

#include <span>
#include <string>
#include <vector>

namespace tsuya {

/// The specs of find_dye, in which each palette `FILE:*` is replaced by the spectra of the file in
/// their order, `FILE:NAME`. Throws Error as read_spectrum_file.
std::vector<std::string> expand_palettes(std::span<const std::string> specs);

} // namespace tsuya

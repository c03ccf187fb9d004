#pragma once
/// \file
/// ICC profiles of displays.

#include <string>

namespace tsuya {

/// The bytes of a profile of one of display_names() but for Rec.2100, whose curves an ICC profile
/// of matrix and curves has not. The same display gives the same bytes. Throws Error for another.
std::string icc_profile(const std::string &display);

} // namespace tsuya

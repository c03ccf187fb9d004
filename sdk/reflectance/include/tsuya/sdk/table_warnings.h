#pragma once
/// \file
/// What is odd about a reflectance table that can be used all the same.

#include <string>
#include <vector>

#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

/// Sentences without full stop, none where nothing is odd:
/// - light that is a little off the normal and counts as light from straight above;
/// - rows that repeat directions of others;
/// - a light under which the values reflect more than they receive, with each view's share of the
///   hemisphere as in `solid_angles`;
/// - standard errors that are larger than the values, in the root mean square;
/// - a value that is more than 30 times those of the four nearest views under the same light: a
///   spike, or a highlight that the views miss.
std::vector<std::string> table_warnings(const ReflectanceTable &table);

} // namespace tsuya

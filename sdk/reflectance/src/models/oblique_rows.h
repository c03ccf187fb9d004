#pragma once
// The rows of a table that are under oblique light.

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

using LightAngles = std::pair<double, double>; // theta_i, phi_i

// The rows that no light from straight above belongs to, light by light. Throws Error naming
// `where`: less than 4 of them; a light whose views are all 0.
std::map<LightAngles, std::vector<ReflectanceRow>> oblique_rows(const ReflectanceTable &table,
                                                                const std::string &where);

} // namespace tsuya

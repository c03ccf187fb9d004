#include "models/oblique_rows.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/error.h"

namespace tsuya {
namespace {

constexpr std::size_t kLeastOblique = 4;

} // namespace

std::map<LightAngles, std::vector<ReflectanceRow>> oblique_rows(const ReflectanceTable &table,
                                                                const std::string &where) {
    std::map<LightAngles, std::vector<ReflectanceRow>> lights;
    std::size_t count = 0;
    for (const ReflectanceRow &row : table.rows)
        if (!row.from_above()) {
            const double turn = 2 * kPi;
            lights[{row.theta_i, row.phi_i - turn * std::floor(row.phi_i / turn)}].push_back(row);
            ++count;
        }
    if (count < kLeastOblique)
        throw Error(
            {"the table has " + std::to_string(count) + " views under oblique light", where,
             "expected " + std::to_string(kLeastOblique) +
                 " or more rows with theta_i_deg above 0, such as 2 under each of 6 lights"});
    for (const auto &[angles, rows] : lights)
        if (std::none_of(rows.begin(), rows.end(),
                         [](const ReflectanceRow &row) { return row.brdf_per_sr > 0; }))
            throw Error({"the views under light at theta_i " +
                             std::to_string(std::lround(angles.first / kDegree)) + ", phi_i " +
                             std::to_string(std::lround(angles.second / kDegree)) +
                             " degrees are all 0",
                         where, "expected a value above 0 under every light"});
    return lights;
}

} // namespace tsuya

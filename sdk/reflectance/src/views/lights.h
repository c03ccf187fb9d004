#pragma once
// The rows of a table light by light.

#include <array>
#include <map>
#include <vector>

#include "tsuya/sdk/progress.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya {

// Rows of one light direction, by theta_i, then phi_i.
inline std::vector<std::vector<ReflectanceRow>> rows_by_light(const ReflectanceTable &table) {
    std::map<std::array<long long, 2>, std::vector<ReflectanceRow>> by_key;
    for (const ReflectanceRow &row : table.rows) {
        const auto key = direction_key(row);
        by_key[{key[0], key[1]}].push_back(row);
    }
    std::vector<std::vector<ReflectanceRow>> lights;
    for (auto &[key, rows] : by_key)
        lights.push_back(std::move(rows));
    return lights;
}

inline std::vector<glm::dvec3> views_of(const std::vector<ReflectanceRow> &rows) {
    std::vector<glm::dvec3> views;
    for (const ReflectanceRow &row : rows)
        views.push_back(row.to_viewer());
    return views;
}

// `solid_angles` of the views of each light. Lights with the same views and the same mirrors, of
// which a table has many, are one question.
std::vector<std::vector<double>>
solid_angles_by_light(const std::vector<std::vector<ReflectanceRow>> &lights, Symmetry symmetry,
                      const Progress &progress = {});

} // namespace tsuya

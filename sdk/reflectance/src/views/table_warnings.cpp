#include "tsuya/sdk/table_warnings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

#include "tsuya/sdk/angle.h"
#include "views/lights.h"

namespace tsuya {
namespace {

using Rows = std::vector<ReflectanceRow>;

constexpr double kRounding = 0.01 * kDegree; // light nearer to the normal needs no word
constexpr double kSpike = 30;                // times the neighbours
constexpr std::size_t kNeighbours = 4, kLeastViews = 6;

template <class... Parts> std::string text_of(const Parts &...parts) {
    std::ostringstream text;
    text.precision(3);
    (text << ... << parts);
    return text.str();
}

std::string rows_of(std::ptrdiff_t count) { return text_of(count, count == 1 ? " row" : " rows"); }

std::string light_name(const ReflectanceRow &row) {
    return text_of("light at theta_i ", row.theta_i / kDegree, ", phi_i ", row.phi_i / kDegree,
                   " degrees");
}

void find_slanting(const ReflectanceTable &table, std::vector<std::string> &found) {
    const auto count = std::ranges::count_if(table.rows, [](const ReflectanceRow &row) {
        return row.from_above() && row.theta_i > kRounding;
    });
    if (count > 0)
        found.push_back(text_of("the light of ", rows_of(count),
                                " is within half a degree of the normal and counts as light "
                                "from straight above"));
}

void find_repeats(const ReflectanceTable &table, std::vector<std::string> &found) {
    std::set<std::array<long long, 4>> known;
    std::ptrdiff_t repeats = 0;
    for (const ReflectanceRow &row : table.rows)
        repeats += !known.insert(direction_key(row)).second;
    if (repeats > 0)
        found.push_back(text_of("the directions of ", rows_of(repeats),
                                " are those of other rows; the mean of their values counts"));
}

void find_large_errors(const ReflectanceTable &table, std::vector<std::string> &found) {
    double values = 0, errors = 0;
    for (const ReflectanceRow &row : table.rows) {
        values += row.brdf_per_sr * row.brdf_per_sr;
        errors += row.sigma_per_sr * row.sigma_per_sr;
    }
    if (values > 0 && errors > values)
        found.push_back(text_of("the standard errors are ", std::sqrt(errors / values),
                                " times the values (root mean square), which says little; are "
                                "they in 1/sr?"));
}

void find_large_albedo(const std::vector<Rows> &lights, Symmetry symmetry,
                       std::vector<std::string> &found) {
    double worst = 1;
    const ReflectanceRow *light = nullptr;
    const std::vector<std::vector<double>> share = solid_angles_by_light(lights, symmetry);
    for (std::size_t l = 0; l < lights.size(); ++l) {
        const Rows &rows = lights[l];
        double albedo = 0;
        for (std::size_t i = 0; i < rows.size(); ++i)
            albedo += share[l][i] * rows[i].brdf_per_sr * rows[i].to_viewer().z;
        if (albedo > worst && rows.size() >= kLeastViews) {
            worst = albedo;
            light = &rows[0];
        }
    }
    if (light)
        found.push_back(text_of("the values reflect ", worst, " times what they receive under ",
                                light_name(*light), "; a white diffuser has 0.318 per sr"));
}

// Largest value of the nearest views in other directions; 0 where there are too few.
double largest_neighbour(const Rows &rows, const ReflectanceRow &of) {
    std::vector<std::pair<double, double>> nearness; // minus cosine, value
    for (const ReflectanceRow &row : rows)
        if (direction_key(row) != direction_key(of))
            nearness.emplace_back(-glm::dot(row.to_viewer(), of.to_viewer()), row.brdf_per_sr);
    const auto end =
        nearness.begin() + static_cast<std::ptrdiff_t>(std::min(kNeighbours, nearness.size()));
    std::partial_sort(nearness.begin(), end, nearness.end());
    double largest = 0;
    for (auto neighbour = nearness.begin(); neighbour != end; ++neighbour)
        largest = std::max(largest, neighbour->second);
    return largest;
}

// The largest value of each light is looked at: a second spike shows when the first is mended.
void find_spikes(const std::vector<Rows> &lights, std::vector<std::string> &found) {
    for (const Rows &rows : lights) {
        const auto &top = *std::ranges::max_element(rows, {}, &ReflectanceRow::brdf_per_sr);
        const double around = largest_neighbour(rows, top);
        if (rows.size() < kLeastViews || !(top.brdf_per_sr > kSpike * around))
            continue;
        found.push_back(text_of("the value ", top.brdf_per_sr, " at theta_r ",
                                top.theta_r / kDegree, ", phi_r ", top.phi_r / kDegree, " under ",
                                light_name(top), " stands alone: the nearest views have at most ",
                                around, "; a spike, or a highlight that the views miss"));
        return; // one is told; a table of sharp highlights would have one under every light
    }
}

} // namespace

std::vector<std::string> table_warnings(const ReflectanceTable &table) {
    std::vector<std::string> found;
    const std::vector<Rows> lights = rows_by_light(table);
    find_slanting(table, found);
    find_repeats(table, found);
    find_large_albedo(lights, table.symmetry, found);
    find_large_errors(table, found);
    find_spikes(lights, found);
    return found;
}

} // namespace tsuya

#include "tsuya/lab/view_geometry.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr double kSameAngle = 1e-6; // radians

long rounded(double angle) { return std::lround(angle / kSameAngle); }

double square(double x) { return x * x; }

/// Views of one light by the half plane that they lie in, each by theta_r.
using HalfPlanes = std::map<long, std::map<double, double>>;

HalfPlanes half_planes(const std::vector<const ReflectanceRow *> &rows) {
    HalfPlanes planes;
    for (const ReflectanceRow *row : rows)
        if (row->theta_r > kSameAngle)
            planes[rounded(row->phi_r)][row->theta_r] = row->brdf_per_sr;
    for (const ReflectanceRow *row : rows) // straight above lies in all of them
        if (row->theta_r <= kSameAngle)
            for (auto &[phi, views] : planes)
                views[0] = row->brdf_per_sr;
    return planes;
}

auto peak_of(const std::map<double, double> &views) {
    return std::max_element(views.begin(), views.end(),
                            [](const auto &a, const auto &b) { return a.second < b.second; });
}

/// From the largest value of a half plane to the nearer half value, twice; pi if there is none.
double width_of(const std::map<double, double> &views) {
    const auto peak = peak_of(views);
    const double half = peak->second / 2;
    double width = kPi;
    const auto cross = [&](const auto &inner, const auto &outer) {
        const double t = (inner.second - half) / (inner.second - outer.second);
        width = std::min(width, 2 * std::abs(std::lerp(inner.first, outer.first, t) - peak->first));
    };
    for (auto at = peak; std::next(at) != views.end(); ++at)
        if (std::next(at)->second <= half) {
            cross(*at, *std::next(at));
            break;
        }
    for (auto at = peak; at != views.begin(); --at)
        if (std::prev(at)->second <= half) {
            cross(*at, *std::prev(at));
            break;
        }
    return width;
}

} // namespace

double patch_length_mm(double side_mm, double theta_r) { return side_mm / std::cos(theta_r); }

double spot_length_mm(double spot_mm, const DirectionPair &directions) {
    // An ellipse whose long axis lies in the plane of incidence.
    const double along = std::cos(directions.phi_r - directions.phi_i),
                 across = std::sin(directions.phi_r - directions.phi_i);
    return spot_mm / std::sqrt(square(along * std::cos(directions.theta_i)) + square(across));
}

double raised_irradiance(double height_mm, double spot_mm, double lamp_mm,
                         const DirectionPair &directions) {
    double irradiance = 1;
    if (spot_mm > 0) {
        const auto axis = [&](double theta, double phi) {
            return height_mm * std::tan(theta) * glm::dvec3(std::cos(phi), std::sin(phi), 0);
        };
        const glm::dvec3 off =
            axis(directions.theta_r, directions.phi_r) - axis(directions.theta_i, directions.phi_i);
        const glm::dvec3 light = directions.to_light();
        const glm::dvec3 across = off - glm::dot(off, light) * light;
        irradiance *= std::exp2(-square(2 * glm::length(across) / spot_mm));
    }
    if (lamp_mm > 0)
        irradiance *= square(lamp_mm / (lamp_mm - height_mm * std::cos(directions.theta_i)));
    return irradiance;
}

double disk_angle(double diameter_mm, double distance_mm) {
    return diameter_mm > 0 && distance_mm > 0 ? 2 * std::atan(diameter_mm / (2 * distance_mm)) : 0;
}

double narrowest_lobe(const ReflectanceTable &table) {
    std::map<std::pair<long, long>, std::vector<const ReflectanceRow *>> lights;
    for (const ReflectanceRow &row : table.rows)
        lights[{rounded(row.theta_i), rounded(row.phi_i)}].push_back(&row);
    double width = kPi;
    for (const auto &[light, rows] : lights) {
        const HalfPlanes planes = half_planes(rows);
        double largest = 0;
        for (const auto &[phi, views] : planes)
            largest = std::max(largest, peak_of(views)->second);
        for (const auto &[phi, views] : planes)
            if (peak_of(views)->second >= largest / 2) // not the foot of a lobe
                width = std::min(width, width_of(views));
    }
    return width;
}

} // namespace tsuya::lab

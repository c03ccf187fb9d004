#pragma once
// What the plots of a fabric share: lights, planes, colours, and data as gnuplot reads it.

#include <array>
#include <functional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/reflectance_table.h"

namespace tsuya::scene {

inline constexpr double kPlottedDecades = 3.5; // of logarithmic scales, below the largest value
inline constexpr double kSameAngle = 1e-3;     // radians
inline constexpr std::array kThetaDeg = {0, 15, 30, 45, 60, 75}; // of the light, as in [Takeda]
inline constexpr std::array<const char *, 6> kThetaColours = {"#30123b", "#4662d7", "#1ae4b6",
                                                              "#7a9a00", "#e06a00", "#a01010"};

// A plane of incidence.
struct Plane {
    const char *name;
    int phi_deg;

    double phi() const { return phi_deg * kDegree; }
    // 'Light in the warp plane, phi_i = 90°'
    std::string title() const;
};
inline constexpr std::array<Plane, 3> kPlanes = {{{"warp", 90}, {"bias", 45}, {"weft", 0}}};

// Difference of two azimuths, in [-pi, pi].
double turn(double a, double b);
bool has_light(const ReflectanceRow &row, double theta_i, double phi_i);

// Numbers in words that gnuplot reads, whatever the locale.
std::string number(double value);
// The same in three digits.
std::string rounded(double value);
// The points that a polyline needs to stay within `tolerance` of all, in order: few where it is
// nearly straight. \param scale of x and y before the distance is taken
std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2> &points, const glm::dvec2 &scale,
                                double tolerance);
// A named block of lines.
std::string block(const std::string &name, const std::string &lines);

// A function over the upper hemisphere.
struct DiskMap {
    std::string block;
    double most; // largest value
};
// On a disk whose radius is the angle from the normal, in degrees; NaN outside. \param stripes_from
// degrees; every few values are left out beyond it, which draws stripes
DiskMap disk_map(const std::string &name, double stripes_from,
                 const std::function<double(double theta, double phi)> &value);
// Palette, axes and circles for such a map: from `most` down, logarithmic.
std::string disk_style(double most);

} // namespace tsuya::scene

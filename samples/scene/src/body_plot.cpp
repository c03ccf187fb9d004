#include "tsuya/scene/body_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gnuplot.h"
#include "plot_data.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

constexpr int kWidth = 1200, kHeight = 1000;
constexpr double kTurnStep = 0.5;     // degrees, about the axis of a projection
constexpr double kTolerance = 0.0025; // of an outline, in largest radii
constexpr double kExtent = 1.05;      // of an axis

// Parallel light along `axis` casts the shadow, on the plane of `across` and `up`.
struct Projection {
    const char *name, *title;
    glm::dvec3 axis, across, up;
    bool whole; // else only the upper half holds something
    const char *across_label, *up_label;
    double bottom, top; // of the picture
};
const std::array<Projection, 3> kProjections = {{
    {"weft",
     "seen along the weft",
     {1, 0, 0},
     {0, 1, 0},
     {0, 0, 1},
     false,
     "warp",
     "normal",
     0.7,
     0.85},
    {"warp",
     "seen along the warp",
     {0, 1, 0},
     {1, 0, 0},
     {0, 0, 1},
     false,
     "weft",
     "normal",
     0.455,
     0.605},
    {"above", "seen from above", {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, true, "weft", "warp", 0.06, 0.36},
}};

using Outline = std::vector<glm::dvec2>;

// The largest of a function of an angle near `best`, in degrees.
template <class Function> double refined(const Function &f, double best, double reach) {
    constexpr double kShare = 0.6180339887498949; // golden section
    double from = best - reach, to = best + reach;
    for (int i = 0; i < 12; ++i) {
        const double low = to - kShare * (to - from), high = from + kShare * (to - from);
        (f(low) > f(high) ? to : from) = f(low) > f(high) ? high : low;
    }
    return std::max(f((from + to) / 2), f(best));
}

// The body holds every point between its surface and the origin, and so does its shadow: the
// outline is the farthest point at each turn about the axis.
Outline outline_of(const BrdfFunction &f, const Projection &seen, const glm::dvec3 &to_light) {
    Outline outline;
    const double turns = seen.whole ? 360 : 180;
    for (double turned = 0; turned <= turns; turned += kTurnStep) {
        const glm::dvec2 way(std::cos(turned * kDegree), std::sin(turned * kDegree));
        const auto radius = [&](double from_axis) {
            const double sine = std::sin(from_axis * kDegree);
            const glm::dvec3 to_viewer = std::cos(from_axis * kDegree) * seen.axis +
                                         sine * (way.x * seen.across + way.y * seen.up);
            return to_viewer.z > 1e-6 ? f(to_light, to_viewer) * to_viewer.z * sine : 0;
        };
        double best = 1;
        for (double from_axis = 2; from_axis < 180; ++from_axis)
            if (radius(from_axis) > radius(best))
                best = from_axis;
        outline.push_back(refined(radius, best, 1) * way);
    }
    return outline;
}

double largest_value(const BrdfFunction &f, const glm::dvec3 &to_light) {
    double most = 0;
    for (double theta = 0; theta < 90; ++theta)
        for (double phi = 0; phi < 360; ++phi) {
            const glm::dvec3 to_viewer = direction_of(theta * kDegree, phi * kDegree);
            most = std::max(most, f(to_light, to_viewer) * to_viewer.z);
        }
    return most;
}

// \param unit the radius that is drawn as 1
std::string lines_of(const Outline &outline, double unit) {
    std::string lines;
    for (const glm::dvec2 &point : thinned(outline, glm::dvec2(1 / unit), kTolerance))
        lines += number(point.x / unit) + " " + number(point.y / unit) + "\n";
    return lines;
}

std::string block_name(const Plane &plane, const Projection &seen, int theta_i) {
    return std::string("body_") + plane.name + "_" + seen.name + "_" + std::to_string(theta_i);
}

using Largest = std::array<double, kThetaDeg.size()>; // values, 1/sr

std::string panel_of(const Plane &plane, const Projection &seen, const Largest &largest) {
    const std::string extent = number(kExtent);
    std::string script = std::string("set title '") + seen.title +
                         "' offset 0,-0.6\nset xlabel 'along the " + seen.across_label +
                         ", of the largest' offset 0,0.5\nset ylabel 'along the " + seen.up_label +
                         "'\nset bmargin at screen " + number(seen.bottom) +
                         "\nset tmargin at screen " + number(seen.top) + "\nset yrange [" +
                         (seen.whole ? "-" + extent : "0") + ":" + extent + "]\nplot ";
    for (std::size_t i = 0; i < kThetaDeg.size(); ++i) {
        const std::string colour = std::string("rgb '") + kThetaColours[i] + "'";
        const std::string name = "$" + block_name(plane, seen, kThetaDeg[i]);
        script += (i > 0 ? ", " : "") + name + " using 1:2 with filledcurves closed fc " + colour +
                  " fs transparent solid 0.12 border lc " + colour + " lw 1.5 title '" +
                  std::to_string(kThetaDeg[i]) + "°: " + rounded(largest[i]) + "'";
    }
    return script + "\nunset key\nunset label\n";
}

// What the panels of a plane of incidence share. \param left of the picture
std::string column_of(const Plane &plane, double left) {
    const std::string at = number(left);
    return "set label 1 " + plane.title() + " at screen " + at + ",0.98 noenhanced\n" +
           "set label 2 'theta_i: largest BRDF × cos theta_r in 1/sr' at screen " + at +
           ",0.955 noenhanced\nset lmargin at screen " + at + "\nset rmargin at screen " +
           number(left + 0.25) + "\nset key at screen " + number(left + 0.245) +
           ",0.94 right top Left reverse samplen 2 vertical maxrows 3 noenhanced\n";
}

constexpr const char *kStyle = R"(
set multiplot
set grid lt 1 lc rgb '#c8c8c8' lw 0.5
set xtics 0.5
set ytics 0.5
set xrange [-1.05:1.05]
)";

} // namespace

void plot_bodies(const Fabric &fabric, const std::string &model,
                 const std::filesystem::path &file) {
    prepare_output_file(file, {".svg", ".png"});
    const BrdfFunction f = make_model(model, fabric, "fabric");
    std::string blocks, panels;
    double left = 0.07;
    for (const Plane &plane : kPlanes) {
        panels += column_of(plane, left);
        left += 0.325;
        Largest largest{};
        for (std::size_t i = 0; i < kThetaDeg.size(); ++i) {
            const glm::dvec3 to_light = direction_of(kThetaDeg[i] * kDegree, plane.phi());
            largest[i] = largest_value(f, to_light);
            for (const Projection &seen : kProjections)
                blocks += block(block_name(plane, seen, kThetaDeg[i]),
                                lines_of(outline_of(f, seen, to_light), largest[i]));
        }
        for (const Projection &seen : kProjections)
            panels += panel_of(plane, seen, largest);
    }
    run_gnuplot(blocks + kStyle + panels + "unset multiplot\n", file, kWidth, kHeight);
}

} // namespace tsuya::scene

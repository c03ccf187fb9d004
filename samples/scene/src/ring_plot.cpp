#include "tsuya/scene/ring_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gnuplot.h"
#include "plot_data.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/error.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

constexpr int kWidth = 1200, kHeight = 1150;
constexpr double kTolerance = 1e-3; // of a curve, in heights of the panel
constexpr std::array kRingDeg = {30, 60};
constexpr std::array<const char *, 7> kModelColours = {"#0060c0", "#e06a00", "#2a9d3a", "#b02090",
                                                       "#8a6d00", "#a01010", "#606060"};

using Curve = std::vector<glm::dvec2>; // phi_r in degrees, BRDF

Curve curve_of(const BrdfFunction &f, const glm::dvec3 &to_light, int ring) {
    Curve curve;
    for (int phi = 0; phi <= 360; ++phi)
        curve.push_back({phi, f(to_light, direction_of(ring * kDegree, phi * kDegree))});
    return curve;
}

std::string lines_of(const Curve &curve, double most) {
    std::string lines;
    const glm::dvec2 scale(1.0 / 180, most > 0 ? 1 / most : 1);
    for (const glm::dvec2 &point : thinned(curve, scale, kTolerance))
        lines += number(point.x) + " " + number(point.y) + "\n";
    return lines;
}

// With the standard error, 0 where unknown.
std::string points_of(const RingPlot &plot, const Plane &plane, int ring, double &most) {
    std::string lines;
    if (!plot.against)
        return lines;
    for (const ReflectanceRow &row : plot.against->rows) {
        if (!has_light(row, plot.theta_i, plane.phi()) ||
            std::abs(row.theta_r - ring * kDegree) > kSameAngle)
            continue;
        const double phi = turn(row.phi_r, 0);
        most = std::max(most, row.brdf_per_sr + row.sigma_per_sr);
        lines += number((phi < -kSameAngle ? phi / kDegree + 360 : phi / kDegree)) + " " +
                 number(row.brdf_per_sr) + " " + number(row.sigma_per_sr) + "\n";
    }
    return lines;
}

// One plane and ring.
struct Panel {
    std::string script{};
    bool measured = false;
};

Panel panel_of(const RingPlot &plot, const std::vector<BrdfFunction> &models, const Plane &plane,
               int ring) {
    const std::string tail = std::string("_") + plane.name + "_" + std::to_string(ring);
    const glm::dvec3 to_light = direction_of(plot.theta_i, plane.phi());
    const int mirror = plane.phi_deg + 180;
    double most = 0;
    std::vector<Curve> values;
    for (const BrdfFunction &f : models) {
        values.push_back(curve_of(f, to_light, ring));
        for (const glm::dvec2 &value : values.back())
            most = std::max(most, value.y);
    }
    const std::string points = points_of(plot, plane, ring, most);
    std::string blocks, curves;
    for (std::size_t i = 0; i < models.size(); ++i) {
        const std::string &name = plot.models[i];
        blocks += block(name + tail, lines_of(values[i], most));
        curves += (i > 0 ? ", $" : "$") + name + tail + " using 1:2 with lines lw 2 lc rgb '" +
                  kModelColours[i % kModelColours.size()] + "' title '" + name + "'";
    }
    if (!points.empty()) {
        blocks += block("measured" + tail, points);
        curves += ", $measured" + tail +
                  " using 1:2:3 with yerrorbars pt 6 ps 0.7 lc rgb 'black' title 'measured'";
    }
    return {blocks + "set title 'Light in the " + plane.name + " plane, theta_i = " +
                number(plot.theta_i / kDegree) + "°, phi_i = " + std::to_string(plane.phi_deg) +
                "°; theta_r = " + std::to_string(ring) + "°' noenhanced\nset yrange [0:" +
                number(most > 0 ? most * 1.4 : 1) + "]\nset arrow 1 from " +
                std::to_string(mirror) + ", graph 0 to " + std::to_string(mirror) +
                ", graph 1 nohead dt 2 lc rgb '#808080'\nplot " + curves + "\n",
            !points.empty()};
}

constexpr const char *kStyle = R"(
set multiplot layout 3,2
set grid lt 1 lc rgb '#c8c8c8' lw 0.5
set xrange [0:360]
set xtics 45
set xlabel 'phi_r from the weft, degrees; dashed: away from the light' noenhanced
set ylabel 'BRDF, 1/sr' noenhanced
set key top left Left reverse vertical maxrows 3 samplen 2 noenhanced
)";

} // namespace

void plot_rings(const RingPlot &plot, const std::filesystem::path &file) {
    prepare_output_file(file, {".svg", ".png"});
    if (!(plot.theta_i >= 0 && plot.theta_i < 90 * kDegree))
        throw Error({"theta_i is " + number(plot.theta_i / kDegree) + " degrees", "theta_i",
                     "expected at least 0 and below 90"});
    if (plot.models.empty())
        throw Error({"no model to draw", "models", "expected at least one name"});
    std::vector<BrdfFunction> models;
    for (const std::string &name : plot.models)
        models.push_back(make_model(name, plot.fabric, "fabric"));
    std::string script = kStyle;
    bool measured = false;
    for (const Plane &plane : kPlanes)
        for (const int ring : kRingDeg) {
            const Panel panel = panel_of(plot, models, plane, ring);
            script += panel.script;
            measured = measured || panel.measured;
        }
    if (plot.against && !measured)
        throw Error({"no measured point lies on a ring", "against",
                     "expected rows with theta_i = " + number(plot.theta_i / kDegree) +
                         ", phi_i = 0, 45 or 90, theta_r = 30 or 60 degrees"});
    run_gnuplot(script + "unset multiplot\n", file, kWidth, kHeight);
}

} // namespace tsuya::scene

#include "tsuya/scene/lobe_plot.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "gnuplot.h"
#include "plot_data.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/angle.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

constexpr int kWidth = 1200, kHeight = 1000;
constexpr double kCurveStep = 1.0; // degrees

// Values of one panel: blocks of gnuplot data, and the largest value.
struct PlaneData {
    std::string blocks{};
    std::array<bool, kThetaDeg.size()> measured{};
    double most = 0;
};

std::string block_name(const char *kind, const Plane &plane, int theta_i) {
    return std::string(kind) + "_" + plane.name + "_" + std::to_string(theta_i);
}

// theta_r in the plane of incidence: > 0 beyond the normal, where the mirror direction is.
std::string curve_of(const BrdfFunction &f, const Plane &plane, int theta_i, double &most) {
    std::string lines;
    const glm::dvec3 to_light = direction_of(theta_i * kDegree, plane.phi());
    for (double theta = -90 + kCurveStep; theta < 90; theta += kCurveStep) {
        const glm::dvec3 to_viewer = direction_of(-theta * kDegree, plane.phi());
        const double value = f(to_light, to_viewer) * to_viewer.z;
        most = std::max(most, value);
        lines += number(theta) + " " + number(value) + "\n";
    }
    return lines;
}

std::string points_of(const ReflectanceTable &table, const Plane &plane, int theta_i,
                      double &most) {
    std::string lines;
    for (const ReflectanceRow &row : table.rows) {
        const double across = std::abs(turn(row.phi_r, plane.phi()));
        const bool near = across < kSameAngle, beyond = kPi - across < kSameAngle;
        const bool up = row.theta_r < kSameAngle; // lies in every plane
        if (!has_light(row, theta_i * kDegree, plane.phi()) || !(near || beyond || up))
            continue;
        const double value = row.brdf_per_sr * std::cos(row.theta_r);
        most = std::max(most, value);
        lines += number((near ? -1 : 1) * row.theta_r / kDegree) + " " + number(value) + "\n";
    }
    return lines;
}

PlaneData data_of(const LobePlot &plot, const BrdfFunction &f, const Plane &plane) {
    PlaneData data;
    for (std::size_t i = 0; i < kThetaDeg.size(); ++i) {
        const auto add = [&](const char *kind, const std::string &lines) {
            data.blocks += block(block_name(kind, plane, kThetaDeg[i]), lines);
        };
        add("curve", curve_of(f, plane, kThetaDeg[i], data.most));
        const std::string points =
            plot.against ? points_of(*plot.against, plane, kThetaDeg[i], data.most) : "";
        data.measured[i] = !points.empty();
        if (data.measured[i])
            add("points", points);
    }
    return data;
}

std::string panel_of(const Plane &plane, const PlaneData &data, double most) {
    std::string script = "set title " + plane.title() + " noenhanced\nset yrange [" +
                         number(most * std::pow(10, -kPlottedDecades)) + ":" + number(most * 1.5) +
                         "]\nplot ";
    for (std::size_t i = 0; i < kThetaDeg.size(); ++i) {
        const std::string colour = std::string("lc rgb '") + kThetaColours[i] + "'";
        script += (i > 0 ? ", $" : "$") + block_name("curve", plane, kThetaDeg[i]) +
                  " using 1:2 with lines lw 2 " + colour + " title '" +
                  std::to_string(kThetaDeg[i]) + "°'";
        if (data.measured[i])
            script += ", $" + block_name("points", plane, kThetaDeg[i]) +
                      " using 1:2 with points pt 6 ps 0.6 " + colour + " notitle";
    }
    return script + "\n";
}

constexpr const char *kCurveStyle = R"(
set multiplot layout 2,2
set grid lt 1 lc rgb '#c8c8c8' lw 0.5
set xrange [-90:90]
set xtics 30
set logscale y
set format y '10^{%T}'
set xlabel 'theta_r, degrees; the light stands at the left' noenhanced
set ylabel 'BRDF × cos theta_r, 1/sr' noenhanced
set key top left Left reverse samplen 2 title 'theta_i' noenhanced
)";

constexpr const char *kMapLabels = R"(
set title 'BRDF under light from straight above' noenhanced
set xlabel 'theta_r along the weft, degrees' noenhanced
set ylabel 'theta_r along the warp, degrees' noenhanced
set cblabel '1/sr'
plot $map using 1:2:3 with image
)";

} // namespace

void plot_lobes(const LobePlot &plot, const std::filesystem::path &file) {
    prepare_output_file(file, {".svg", ".png"});
    const BrdfFunction f = make_model(plot.model, plot.fabric, "fabric");
    std::string script;
    double most = 0;
    std::array<PlaneData, kPlanes.size()> data;
    for (std::size_t i = 0; i < kPlanes.size(); ++i) {
        data[i] = data_of(plot, f, kPlanes[i]);
        script += data[i].blocks;
        most = std::max(most, data[i].most);
    }
    script += kCurveStyle;
    for (std::size_t i = 0; i < kPlanes.size(); ++i)
        script += panel_of(kPlanes[i], data[i], most);
    if (const Bard *const bard = views_of(plot.fabric); bard && bard->peak() > 0) {
        const DiskMap map = disk_map("map", 90, [&](double theta, double phi) {
            return bard->at(direction_of(theta, phi));
        });
        script = map.block + script + disk_style(map.most) + kMapLabels;
    }
    run_gnuplot(script + "unset multiplot\n", file, kWidth, kHeight);
}

} // namespace tsuya::scene

#include "tsuya/scene/lobe_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <numbers>
#include <sstream>

#include "gnuplot.h"
#include "tsuya/scene/output_file.h"
#include "tsuya/sdk/model.h"

namespace tsuya::scene {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr int kWidth = 1200, kHeight = 1000;
constexpr double kDecades = 3.5;    // below the largest value
constexpr double kCurveStep = 1.0;  // degrees
constexpr double kMapStep = 1.0;    // degrees
constexpr double kSameAngle = 1e-3; // radians
constexpr std::array<int, 6> kThetas = {0, 15, 30, 45, 60, 75};
constexpr std::array<const char *, 6> kColours = {"#30123b", "#4662d7", "#1ae4b6",
                                                  "#7a9a00", "#e06a00", "#a01010"};

struct Plane {
    const char *name;
    double phi; // radians
};
constexpr std::array<Plane, 3> kPlanes = {{{"warp", kPi / 2}, {"bias", kPi / 4}, {"weft", 0.0}}};

glm::dvec3 direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

// Difference of two azimuths, in [-pi, pi].
double turn(double a, double b) { return std::remainder(a - b, 2 * kPi); }

// Values of one panel: blocks of gnuplot data, and the largest value.
struct PlaneData {
    std::string blocks{};
    std::array<bool, kThetas.size()> measured{};
    double most = 0;
};

std::string block_name(const char *kind, const Plane &plane, int theta_i) {
    return std::string("$") + kind + "_" + plane.name + "_" + std::to_string(theta_i);
}

// theta_r in the plane of incidence: > 0 beyond the normal, where the mirror direction is.
std::string curve_of(const BrdfFunction &f, const Plane &plane, int theta_i, double &most) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    const glm::dvec3 to_light = direction(theta_i * kDegree, plane.phi);
    for (double theta = -90 + kCurveStep; theta < 90; theta += kCurveStep) {
        const glm::dvec3 to_viewer = direction(-theta * kDegree, plane.phi);
        const double value = f(to_light, to_viewer) * to_viewer.z;
        most = std::max(most, value);
        out << theta << " " << value << "\n";
    }
    return out.str();
}

std::string points_of(const ReflectanceTable &table, const Plane &plane, int theta_i,
                      double &most) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    for (const ReflectanceRow &row : table.rows) {
        const bool same_light = std::abs(row.theta_i - theta_i * kDegree) < kSameAngle &&
                                (theta_i == 0 || std::abs(turn(row.phi_i, plane.phi)) < kSameAngle);
        const double across = std::abs(turn(row.phi_r, plane.phi));
        const bool near = across < kSameAngle, beyond = kPi - across < kSameAngle;
        const bool up = row.theta_r < kSameAngle; // lies in every plane
        if (!same_light || !(near || beyond || up))
            continue;
        const double value = row.brdf_per_sr * std::cos(row.theta_r);
        most = std::max(most, value);
        out << (near ? -1 : 1) * row.theta_r / kDegree << " " << value << "\n";
    }
    return out.str();
}

PlaneData data_of(const LobePlot &plot, const BrdfFunction &f, const Plane &plane) {
    PlaneData data;
    for (std::size_t i = 0; i < kThetas.size(); ++i) {
        const auto add = [&](const char *kind, const std::string &lines) {
            data.blocks += block_name(kind, plane, kThetas[i]) + " << END\n" + lines + "END\n";
        };
        add("curve", curve_of(f, plane, kThetas[i], data.most));
        const std::string points =
            plot.against ? points_of(*plot.against, plane, kThetas[i], data.most) : "";
        data.measured[i] = !points.empty();
        if (data.measured[i])
            add("points", points);
    }
    return data;
}

std::string panel_of(const Plane &plane, const PlaneData &data, double most) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << "set title 'Light in the " << plane.name
        << " plane, phi_i = " << std::lround(plane.phi / kDegree) << "°' noenhanced\n"
        << "set yrange [" << most * std::pow(10, -kDecades) << ":" << most * 1.5 << "]\nplot ";
    for (std::size_t i = 0; i < kThetas.size(); ++i) {
        const std::string colour = std::string("lc rgb '") + kColours[i] + "'";
        out << (i > 0 ? ", " : "") << block_name("curve", plane, kThetas[i])
            << " using 1:2 with lines lw 2 " << colour << " title '" << kThetas[i] << "°'";
        if (data.measured[i])
            out << ", " << block_name("points", plane, kThetas[i])
                << " using 1:2 with points pt 6 ps 0.6 " << colour << " notitle";
    }
    out << "\n";
    return out.str();
}

// rho0 over the disk whose radius is theta, in degrees.
std::string map_of(const Bard &bard) {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    double most = 0;
    out << "$map << END\n";
    for (double y = -90; y <= 90; y += kMapStep) {
        for (double x = -90; x <= 90; x += kMapStep) {
            const double theta = std::hypot(x, y);
            out << x << " " << y << " ";
            if (theta <= 90) {
                const double value = bard.at(direction(theta * kDegree, std::atan2(y, x)));
                most = std::max(most, value);
                out << value << "\n";
            } else {
                out << "NaN\n";
            }
        }
        out << "\n";
    }
    out << "END\nset cbrange [" << most * std::pow(10, -kDecades) << ":" << most << "]\n";
    return out.str();
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

constexpr const char *kMapStyle = R"(
unset logscale y
set key off
set title 'BRDF under light from straight above' noenhanced
set xlabel 'theta_r along the weft, degrees' noenhanced
set ylabel 'theta_r along the warp, degrees' noenhanced
set cblabel '1/sr'
set size ratio -1
set format y '%g'
set xrange [-91:91]
set yrange [-91:91]
set ytics 30
set logscale cb
set format cb '%g'
set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')
set object 1 circle at 0,0 size 30 front fs empty border rgb '#ffffff' lw 0.5
set object 2 circle at 0,0 size 60 front fs empty border rgb '#ffffff' lw 0.5
set object 3 circle at 0,0 size 90 front fs empty border rgb '#606060' lw 0.5
plot $map using 1:2:3 with image
unset multiplot
)";

} // namespace

void plot_lobes(const LobePlot &plot, const std::filesystem::path &file) {
    prepare_output_file(file, {".svg", ".png"});
    const BrdfFunction f = make_model(plot.model, plot.fabric, "fabric");
    std::string blocks, panels;
    double most = 0;
    std::array<PlaneData, kPlanes.size()> data;
    for (std::size_t i = 0; i < kPlanes.size(); ++i) {
        data[i] = data_of(plot, f, kPlanes[i]);
        blocks += data[i].blocks;
        most = std::max(most, data[i].most);
    }
    for (std::size_t i = 0; i < kPlanes.size(); ++i)
        panels += panel_of(kPlanes[i], data[i], most);
    run_gnuplot(blocks + map_of(*plot.fabric.bard) + kCurveStyle + panels + kMapStyle, file, kWidth,
                kHeight);
}

} // namespace tsuya::scene

#include "plot_data.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace tsuya::scene {
namespace {

constexpr int kStripes = 6; // degrees from one to the next

constexpr const char *kDiskStyle = R"(
unset logscale y
unset grid
set key off
set size ratio -1
set format x '%g'
set format y '%g'
set xrange [-91:91]
set yrange [-91:91]
set xtics 30
set ytics 30
set logscale cb
set format cb '%g'
set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')
set object 1 circle at 0,0 size 30 front fs empty border rgb '#ffffff' lw 0.5
set object 2 circle at 0,0 size 60 front fs empty border rgb '#ffffff' lw 0.5
set object 3 circle at 0,0 size 90 front fs empty border rgb '#606060' lw 0.5
)";

std::string written(double value, int digits) {
    if (!std::isfinite(value))
        return "NaN";
    std::ostringstream out;
    out.imbue(std::locale::classic());
    out << std::setprecision(digits) << value;
    return out.str();
}

double distance_to_segment(const glm::dvec2 &point, const glm::dvec2 &from, const glm::dvec2 &to) {
    const glm::dvec2 along = to - from;
    const double length2 = glm::dot(along, along);
    const double share =
        length2 > 0 ? std::clamp(glm::dot(point - from, along) / length2, 0.0, 1.0) : 0.0;
    return glm::distance(point, from + share * along);
}

// Marks the farthest point between two kept ones, and so on in both parts.
void keep_between(const std::vector<glm::dvec2> &points, const glm::dvec2 &scale, double tolerance,
                  std::size_t from, std::size_t to, std::vector<bool> &kept) {
    double most = tolerance;
    std::size_t farthest = from;
    for (std::size_t i = from + 1; i < to; ++i) {
        const double apart =
            distance_to_segment(points[i] * scale, points[from] * scale, points[to] * scale);
        if (apart > most) {
            most = apart;
            farthest = i;
        }
    }
    if (farthest == from)
        return;
    kept[farthest] = true;
    keep_between(points, scale, tolerance, from, farthest, kept);
    keep_between(points, scale, tolerance, farthest, to, kept);
}

} // namespace

std::string Plane::title() const {
    return std::string("'Light in the ") + name + " plane, phi_i = " + std::to_string(phi_deg) +
           "°'";
}

double turn(double a, double b) { return std::remainder(a - b, 2 * kPi); }

bool has_light(const ReflectanceRow &row, double theta_i, double phi_i) {
    if (row.from_above())
        return theta_i <= kNormalLight;
    return std::abs(row.theta_i - theta_i) < kSameAngle &&
           std::abs(turn(row.phi_i, phi_i)) < kSameAngle;
}

std::string number(double value) { return written(value, 6); }
std::string rounded(double value) { return written(value, 3); }

std::vector<glm::dvec2> thinned(const std::vector<glm::dvec2> &points, const glm::dvec2 &scale,
                                double tolerance) {
    if (points.size() < 3)
        return points;
    std::vector<bool> kept(points.size(), false);
    kept.front() = kept.back() = true;
    keep_between(points, scale, tolerance, 0, points.size() - 1, kept);
    std::vector<glm::dvec2> result;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (kept[i])
            result.push_back(points[i]);
    return result;
}

std::string block(const std::string &name, const std::string &lines) {
    return "$" + name + " << END\n" + lines + "END\n";
}

DiskMap disk_map(const std::string &name, double stripes_from,
                 const std::function<double(double theta, double phi)> &value) {
    std::string lines;
    double most = 0;
    // One value a degree
    for (int y = -90; y <= 90; ++y) {
        for (int x = -90; x <= 90; ++x) {
            const double theta = std::hypot(x, y);
            const bool stripe = theta > stripes_from && (x + y + 180) % kStripes == 0;
            double shown = std::nan("");
            if (theta <= 90 && !stripe) {
                shown = value(theta * kDegree, std::atan2(y, x));
                most = std::max(most, shown);
            }
            lines += number(x) + " " + number(y) + " " + number(shown) + "\n";
        }
        lines += "\n";
    }
    return {block(name, lines), most};
}

std::string disk_style(double most) {
    return kDiskStyle + std::string("set cbrange [") +
           number(most * std::pow(10, -kPlottedDecades)) + ":" + number(most) + "]\n";
}

} // namespace tsuya::scene

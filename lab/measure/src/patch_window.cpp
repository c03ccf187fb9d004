#include "tsuya/lab/patch_window.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya::lab {
namespace {

constexpr double kHannRepeats = 3;
constexpr int kHannPoints = 4; // along a pixel's side, for the mean of the window over it

using Polygon = std::vector<glm::dvec2>;

/// The part of a polygon on the side of a line where dot(normal, p) <= offset.
Polygon clipped(const Polygon &polygon, const glm::dvec2 &normal, double offset) {
    Polygon inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double dp = glm::dot(normal, p) - offset, dq = glm::dot(normal, q) - offset;
        if (dp <= 0)
            inside.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
            inside.push_back(p + (q - p) * (dp / (dp - dq)));
    }
    return inside;
}

double cross(const glm::dvec2 &a, const glm::dvec2 &b) { return a.x * b.y - a.y * b.x; }

double area_of(const Polygon &polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i)
        twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
    return std::abs(twice) / 2;
}

/// How much of the pixel whose corner is (x, y) lies in the polygon.
double share_of_pixel(Polygon polygon, double x, double y) {
    polygon = clipped(polygon, {-1, 0}, -x);
    polygon = clipped(polygon, {1, 0}, x + 1);
    polygon = clipped(polygon, {0, -1}, -y);
    polygon = clipped(polygon, {0, 1}, y + 1);
    return area_of(polygon);
}

PatchWindow scaled(std::vector<double> weights) {
    double sum = 0;
    for (const double weight : weights)
        sum += weight;
    for (double &weight : weights)
        weight /= sum;
    return {.weights = std::move(weights), .whole_repeats = true};
}

template <class Weight> PatchWindow window(int side, const Weight &weight) {
    std::vector<double> weights;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            weights.push_back(weight(x - side / 2.0, y - side / 2.0));
    return scaled(std::move(weights));
}

/// A parallelogram of n wefts and m warps about the middle fits into the patch.
bool fits(int side, const PictureLattice &lattice, double n, double m) {
    const glm::dvec2 reach = n * glm::abs(lattice.weft) + m * glm::abs(lattice.warp);
    return reach.x <= side * (1 + 1e-9) && reach.y <= side * (1 + 1e-9);
}

PatchWindow hann_window(int side, const PictureLattice &lattice, double repeats) {
    const double determinant = cross(lattice.weft, lattice.warp);
    const auto hann = [&](double along) {
        const double t = along / repeats; // -1/2 to 1/2 across the window
        return std::abs(t) < 0.5 ? 0.5 + 0.5 * std::cos(2 * kPi * t) : 0.0;
    };
    return window(side, [&](double x, double y) {
        double sum = 0;
        for (int i = 0; i < kHannPoints * kHannPoints; ++i) {
            const int column = i % kHannPoints, row = i / kHannPoints;
            const glm::dvec2 p(x + (column + 0.5) / kHannPoints, y + (row + 0.5) / kHannPoints);
            sum += hann(cross(p, lattice.warp) / determinant) *
                   hann(cross(lattice.weft, p) / determinant);
        }
        return sum;
    });
}

} // namespace

PictureLattice lattice_in_picture(const std::array<double, 2> &repeat_mm, double pixel_mm,
                                  const DirectionPair &directions) {
    const double cosine = std::cos(directions.theta_r), c = std::cos(directions.phi_r),
                 s = std::sin(directions.phi_r);
    // Of a point of the cloth: across the plane of view, and along it.
    const auto seen = [&](double x, double y) {
        return glm::dvec2(-x * s + y * c, (x * c + y * s) * cosine) / pixel_mm;
    };
    return {.weft = seen(repeat_mm[0], 0), .warp = seen(0, repeat_mm[1])};
}

PatchWindow even_window(int side) {
    PatchWindow even = window(side, [](double, double) { return 1.0; });
    even.whole_repeats = false;
    return even;
}

PatchWindow repeat_window(int side, const PictureLattice &lattice) {
    const glm::dvec2 reach = glm::abs(lattice.weft) + glm::abs(lattice.warp);
    const double both = side / std::max(reach.x, reach.y);
    if (both >= kHannRepeats)
        return hann_window(side, lattice, both);
    int best_n = 0, best_m = 0;
    for (int n = 1; fits(side, lattice, n, 1); ++n)
        for (int m = 1; fits(side, lattice, n, m); ++m)
            if (n * m > best_n * best_m) {
                best_n = n;
                best_m = m;
            }
    if (best_n == 0)
        return even_window(side);
    const glm::dvec2 u = double(best_n) * lattice.weft / 2.0,
                     v = double(best_m) * lattice.warp / 2.0;
    const Polygon repeats{u + v, u - v, -u - v, v - u};
    return window(side, [&](double x, double y) { return share_of_pixel(repeats, x, y); });
}

} // namespace tsuya::lab

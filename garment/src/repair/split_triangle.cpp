#include "repair/split_triangle.h"

#include <algorithm>

namespace tsuya::garment {
namespace {

double cross(const glm::dvec2 &a, const glm::dvec2 &b) { return a.x * b.y - a.y * b.x; }

/// Height over the longest side of the ear at `i`, or 0 where the ear or what remains without it
/// would have no area.
double ear_quality(const std::vector<glm::dvec2> &polygon, const std::vector<std::uint32_t> &left,
                   std::size_t i) {
    constexpr double kFlat = 1e-9; // height over length below which points count as on one line
    const std::size_t n = left.size();
    const glm::dvec2 a = polygon[left[(i + n - 1) % n]], b = polygon[left[i]],
                     c = polygon[left[(i + 1) % n]];
    const glm::dvec2 ac = c - a;
    const double flat = kFlat * glm::dot(ac, ac);
    for (std::size_t k = 2; k + 1 < n; ++k)
        if (cross(ac, polygon[left[(i + k) % n]] - a) <= flat)
            return 0.0;
    const double longest =
        std::max({glm::dot(ac, ac), glm::dot(b - a, b - a), glm::dot(c - b, c - b)});
    return longest > 0.0 ? std::max(0.0, cross(b - a, ac) / longest) : 0.0;
}

} // namespace

std::vector<std::array<std::uint32_t, 3>> split_triangle(const std::vector<glm::dvec2> &polygon) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> left(polygon.size());
    for (std::uint32_t i = 0; i < left.size(); ++i)
        left[i] = i;
    while (left.size() > 3) {
        std::size_t best = 0;
        double best_quality = -1.0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            const double quality = ear_quality(polygon, left, i);
            if (quality > best_quality) {
                best = i;
                best_quality = quality;
            }
        }
        const std::size_t n = left.size();
        triangles.push_back({left[(best + n - 1) % n], left[best], left[(best + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(best));
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

} // namespace tsuya::garment

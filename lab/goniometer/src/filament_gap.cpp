#include "filament_gap.h"

#include <algorithm>
#include <cmath>

namespace tsuya::lab {
namespace {

// Distance between two segments.
double distance(const Capsule &p, const Capsule &q) {
    const glm::dvec3 a(p.from), b(q.from), u = glm::dvec3(p.to) - a, v = glm::dvec3(q.to) - b;
    const glm::dvec3 w = a - b;
    const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
    const double uw = glm::dot(u, w), vw = glm::dot(v, w), area = uu * vv - uv * uv;
    double s = area > 1e-12 * uu * vv ? std::clamp((uv * vw - uw * vv) / area, 0.0, 1.0) : 0;
    double t = (uv * s + vw) / vv;
    if (t < 0 || t > 1) { // the nearest point is an end of q
        t = std::clamp(t, 0.0, 1.0);
        s = std::clamp((uv * t - uw) / uu, 0.0, 1.0);
    }
    return glm::distance(a + s * u, b + t * v);
}

// About the axis of a capsule.
struct Ball {
    glm::vec3 middle;
    float radius;
};

struct Entry {
    std::uint64_t cell;
    std::uint32_t capsule;
    bool operator<(const Entry &other) const {
        return cell != other.cell ? cell < other.cell : capsule < other.capsule;
    }
};

// The cells of a grid that capsules lie in or near, sorted.
std::vector<Entry> grid_of(const std::vector<Capsule> &capsules) {
    float largest = 0, longest = 0;
    for (const Capsule &c : capsules) {
        largest = std::max(largest, c.radius);
        longest = std::max(longest, glm::distance(c.from, c.to));
    }
    const float size = std::max(2 * largest, 0.25f * longest);
    std::vector<Entry> entries;
    for (std::uint32_t i = 0; i < capsules.size(); ++i) {
        const Capsule &c = capsules[i];
        // Two capsules nearer than the sum of their radii meet in a cell
        const glm::ivec3 low(glm::floor((glm::min(c.from, c.to) - 2 * c.radius) / size));
        const glm::ivec3 high(glm::floor((glm::max(c.from, c.to) + 2 * c.radius) / size));
        for (int x = low.x; x <= high.x; ++x)
            for (int y = low.y; y <= high.y; ++y)
                for (int z = low.z; z <= high.z; ++z) {
                    constexpr int kMiddle = 1 << 20;
                    const auto place = [](int v) {
                        return static_cast<std::uint64_t>(v + kMiddle);
                    };
                    entries.push_back({place(x) << 42 | place(y) << 21 | place(z), i});
                }
    }
    std::sort(entries.begin(), entries.end());
    return entries;
}

} // namespace

double least_gap(const std::vector<Capsule> &capsules) {
    const std::vector<Entry> entries = grid_of(capsules);
    std::vector<Ball> balls;
    for (const Capsule &c : capsules)
        balls.push_back({0.5f * (c.from + c.to), 0.5f * glm::distance(c.from, c.to)});
    double least = 1;
    for (std::size_t first = 0, end = 0; first < entries.size(); first = end) {
        while (end < entries.size() && entries[end].cell == entries[first].cell)
            ++end;
        for (std::size_t i = first; i < end; ++i)
            for (std::size_t j = i + 1; j < end; ++j) {
                const Capsule &a = capsules[entries[i].capsule], &b = capsules[entries[j].capsule];
                if (a.strand == b.strand)
                    continue;
                const Ball &p = balls[entries[i].capsule], &q = balls[entries[j].capsule];
                const glm::vec3 d = p.middle - q.middle; // farther apart than that
                const float reach =
                    p.radius + q.radius + static_cast<float>(1 + least) * (a.radius + b.radius);
                if (glm::dot(d, d) < reach * reach)
                    least = std::min(least, distance(a, b) / (a.radius + b.radius) - 1);
            }
    }
    return least;
}

} // namespace tsuya::lab

#include "tsuya/sdk/accuracy.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>

namespace tsuya {
namespace {

constexpr int kRings = 360;            // of the counting grid: a quarter of a degree
constexpr double kSameAngle = 1e-9;    // radians, against rounding
constexpr double kKeptLight = 1e-6;    // a mirror image as near as this is the light itself
constexpr int kLeastPointsOfRing = 48; // about the pole

struct Node {
    glm::dvec3 direction;
    double theta;
    std::size_t owner;
};

// Signs of x and y under the operations of a symmetry that leave the light where it is.
std::vector<glm::dvec3> kept_mirrors(const glm::dvec3 &to_light, Symmetry symmetry) {
    std::vector<glm::dvec3> all = {{1, 1, 1}};
    if (symmetry != Symmetry::none)
        all.push_back({-1, -1, 1});
    if (symmetry == Symmetry::orthotropic)
        all.insert(all.end(), {{1, -1, 1}, {-1, 1, 1}});
    std::erase_if(all, [&](const glm::dvec3 &mirror) {
        return glm::distance(mirror * to_light, to_light) > kKeptLight;
    });
    return all;
}

std::vector<Node> make_nodes(std::span<const glm::dvec3> to_viewer,
                             const std::vector<glm::dvec3> &mirrors) {
    std::vector<Node> nodes;
    for (std::size_t i = 0; i < to_viewer.size(); ++i)
        for (const glm::dvec3 &mirror : mirrors) {
            const glm::dvec3 d = mirror * to_viewer[i];
            nodes.push_back({d, std::atan2(std::hypot(d.x, d.y), d.z), i});
        }
    std::stable_sort(nodes.begin(), nodes.end(),
                     [](const Node &a, const Node &b) { return a.theta < b.theta; });
    return nodes;
}

// The nodes at the least distance from a direction; there are several where they coincide. Walks
// away from the direction's own theta until theta alone is too far.
void find_nearest(const std::vector<Node> &nodes, const glm::dvec3 &d, double theta,
                  std::vector<std::size_t> &nearest) {
    constexpr double kSameCosine = 1e-15; // rounding
    auto up = std::lower_bound(nodes.begin(), nodes.end(), theta,
                               [](const Node &n, double t) { return n.theta < t; });
    auto down = up;
    double best = -2, reach = 2 * kPi; // cosine and angle of the nearest so far
    nearest.clear();
    const auto take = [&](const Node &node) {
        const double cosine = glm::dot(node.direction, d);
        if (cosine > best + kSameCosine) {
            best = cosine;
            reach = std::acos(std::clamp(cosine, -1.0, 1.0)) + kSameAngle;
            nearest.clear();
        }
        if (cosine >= best - kSameCosine)
            nearest.push_back(node.owner);
    };
    while (true) {
        const bool can_up = up != nodes.end() && up->theta - theta <= reach;
        const bool can_down = down != nodes.begin() && theta - std::prev(down)->theta <= reach;
        if (!can_up && !can_down)
            return;
        if (can_up)
            take(*up++);
        if (can_down)
            take(*--down);
    }
}

} // namespace

std::vector<double> solid_angles(std::span<const glm::dvec3> to_viewer, const glm::dvec3 &to_light,
                                 Symmetry symmetry) {
    const std::vector<Node> nodes = make_nodes(to_viewer, kept_mirrors(to_light, symmetry));
    std::vector<double> area(to_viewer.size(), 0.0);
    std::vector<std::size_t> nearest;
    constexpr double kStep = 0.5 * kPi / kRings;
    for (int ring = 0; ring < kRings; ++ring) {
        const double theta = (ring + 0.5) * kStep;
        const int points =
            4 * std::max(kLeastPointsOfRing / 4, static_cast<int>(kRings * std::sin(theta)));
        const double share =
            (std::cos(ring * kStep) - std::cos((ring + 1) * kStep)) * 2 * kPi / points;
        for (int i = 0; i < points; ++i) {
            const double phi = (i + 0.5) * 2 * kPi / points;
            const glm::dvec3 d = direction_of(theta, phi);
            find_nearest(nodes, d, theta, nearest);
            for (const std::size_t owner : nearest)
                area[owner] += share / static_cast<double>(nearest.size());
        }
    }
    return area;
}

} // namespace tsuya

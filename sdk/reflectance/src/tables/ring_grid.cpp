#include "tsuya/sdk/detail/ring_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace tsuya {
namespace {

constexpr float kTwoPi = 6.28318531f;
constexpr double kSameAngle = 1e-5; // radians: directions of one ring

float azimuth_of(double x, double y) {
    const auto phi = static_cast<float>(std::atan2(y, x));
    return phi < 0 ? phi + kTwoPi : phi;
}

} // namespace

RingGrid::RingGrid(const std::vector<glm::dvec3> &directions) {
    std::map<long, std::vector<std::pair<float, std::size_t>>> by_theta;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec3 &d = directions[i];
        const double theta = std::atan2(std::hypot(d.x, d.y), d.z);
        by_theta[std::lround(theta / kSameAngle)].emplace_back(azimuth_of(d.x, d.y), i);
    }
    for (auto &[theta, members] : by_theta) {
        std::sort(members.begin(), members.end());
        Ring ring{.theta = static_cast<float>(static_cast<double>(theta) * kSameAngle)};
        for (const auto &[phi, index] : members) {
            ring.phi.push_back(phi);
            ring.index.push_back(index);
        }
        rings_.push_back(std::move(ring));
    }
}

void RingGrid::add(const Ring &ring, float phi, float share, Corners &corners) const {
    if (!(share > 0))
        return;
    const std::size_t n = ring.phi.size();
    const auto above = static_cast<std::size_t>(
        std::upper_bound(ring.phi.begin(), ring.phi.end(), phi) - ring.phi.begin());
    const std::size_t right = above % n, left = (above + n - 1) % n;
    float span = ring.phi[right] - ring.phi[left], part = phi - ring.phi[left];
    span += span <= 0 ? kTwoPi : 0; // over the weft axis
    part += part < 0 ? kTwoPi : 0;
    const float t = n > 1 ? std::min(part / span, 1.0f) : 0.0f;
    corners.corner[corners.count++] = {ring.index[left], share * (1 - t)};
    if (t > 0)
        corners.corner[corners.count++] = {ring.index[right], share * t};
}

RingGrid::Corners RingGrid::about(const glm::vec3 &d) const {
    const float theta = std::atan2(std::hypot(d.x, d.y), d.z);
    const float phi = azimuth_of(d.x, d.y);
    Corners corners;
    const auto above = std::upper_bound(rings_.begin(), rings_.end(), theta,
                                        [](float t, const Ring &ring) { return t < ring.theta; });
    if (above == rings_.begin() || above == rings_.end()) {
        add(above == rings_.begin() ? rings_.front() : rings_.back(), phi, 1, corners);
        return corners;
    }
    const Ring &inner = *std::prev(above), &outer = *above;
    const float t = (theta - inner.theta) / (outer.theta - inner.theta);
    add(inner, phi, 1 - t, corners);
    add(outer, phi, t, corners);
    return corners;
}

} // namespace tsuya

#include "view_order.h"

#include "tsuya/lab/rig_motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

namespace tsuya::lab {
namespace {

constexpr double kSame = 1e-6; // degrees: angles that are nearer are one

/// A pair with the angles of its axes, slowest first.
struct Candidate {
    DirectionPair pair{};
    AxisAngles angles{};
};

std::array<std::size_t, kAxes> slowest_first(const RigFile &rig) {
    std::array<std::size_t, kAxes> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return rig.axes[a].move > rig.axes[b].move;
    });
    return order;
}

Candidate candidate_of(const DirectionPair &pair, const std::array<std::size_t, kAxes> &order) {
    const AxisAngles angles = axis_angles_deg(pair);
    Candidate candidate{.pair = pair};
    for (std::size_t i = 0; i < kAxes; ++i)
        candidate.angles[i] = std::round(angles[order[i]] / kSame) * kSame;
    return candidate;
}

/// Forth and back: an axis that has been passed over several angles goes the other way the next
/// time. \param forth by axis, whether it is to go forth
void order_by(std::span<Candidate> candidates, std::size_t axis, std::array<bool, kAxes> &forth) {
    if (axis == kAxes)
        return;
    std::stable_sort(
        candidates.begin(), candidates.end(), [&](const Candidate &a, const Candidate &b) {
            return forth[axis] ? a.angles[axis] < b.angles[axis] : a.angles[axis] > b.angles[axis];
        });
    if (candidates.front().angles[axis] != candidates.back().angles[axis])
        forth[axis] = !forth[axis];
    for (auto begin = candidates.begin(); begin != candidates.end();) {
        const auto end = std::find_if(begin, candidates.end(), [&](const Candidate &c) {
            return c.angles[axis] != begin->angles[axis];
        });
        order_by(std::span(begin, end), axis + 1, forth);
        begin = end;
    }
}

/// The lights in the order of their angles, forth and back in the azimuth.
std::vector<std::vector<Candidate>> by_light(std::vector<Candidate> candidates) {
    const auto key = [](const Candidate &c) {
        return std::pair(std::round(c.pair.theta_i / (kSame * kDegree)),
                         std::round(c.pair.phi_i / (kSame * kDegree)));
    };
    std::stable_sort(candidates.begin(), candidates.end(),
                     [&](const Candidate &a, const Candidate &b) { return key(a) < key(b); });
    std::vector<std::vector<Candidate>> lights;
    for (const Candidate &candidate : candidates) {
        if (lights.empty() || key(lights.back().front()) != key(candidate))
            lights.emplace_back();
        lights.back().push_back(candidate);
    }
    return lights;
}

} // namespace

std::vector<LightViews> ordered_views(const std::vector<DirectionPair> &pairs, const RigFile &rig) {
    const auto order = slowest_first(rig);
    std::vector<Candidate> candidates;
    for (const DirectionPair &pair : pairs)
        candidates.push_back(candidate_of(pair, order));
    std::vector<LightViews> lights;
    std::array<bool, kAxes> forth;
    forth.fill(true);
    for (std::vector<Candidate> &light : by_light(std::move(candidates))) {
        order_by(light, 0, forth);
        LightViews views{.theta_i = light[0].pair.theta_i, .phi_i = light[0].pair.phi_i};
        const Candidate *last = nullptr;
        for (const Candidate &candidate : light) {
            if (!last || last->angles != candidate.angles)
                views.views.push_back(candidate.pair);
            last = &candidate;
        }
        lights.push_back(std::move(views));
    }
    return lights;
}

} // namespace tsuya::lab

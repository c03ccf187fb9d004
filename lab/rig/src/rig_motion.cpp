#include "tsuya/lab/rig_motion.h"

#include "tsuya/lab/number_text.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace tsuya::lab {
namespace {

constexpr double kTurn = 360;
constexpr double kRounding = 1e-9; // degrees: a limit is reached by an angle that is equal to it

double azimuth_deg(double angle) {
    const double degrees = std::remainder(angle / kDegree, kTurn);
    return degrees <= -kTurn / 2 ? degrees + kTurn : degrees;
}

bool is_azimuth(AxisName name) { return name == AxisName::stage || name == AxisName::lamp_phi; }

/// The reachable position nearest to `from`.
std::optional<double> reachable_deg(const RigAxis &axis, AxisName name, double angle_deg,
                                    double from) {
    std::optional<double> best;
    const int turns = is_azimuth(name) ? 4 : 0; // more than limits and zero can be apart
    for (int turn = -turns; turn <= turns; ++turn) {
        const double position = axis.position_deg(angle_deg) + turn * kTurn;
        if (position >= axis.limits_deg[0] - kRounding &&
            position <= axis.limits_deg[1] + kRounding &&
            (!best || std::abs(position - from) < std::abs(*best - from)))
            best = position;
    }
    return best;
}

} // namespace

AxisAngles axis_angles_deg(const DirectionPair &pair) {
    AxisAngles angles{};
    const auto set = [&](AxisName name, double degrees) {
        angles[static_cast<std::size_t>(name)] = degrees;
    };
    set(AxisName::lamp_theta, pair.theta_i / kDegree);
    set(AxisName::lamp_phi, azimuth_deg(pair.phi_i - pair.phi_r));
    set(AxisName::camera, pair.theta_r / kDegree);
    set(AxisName::stage, azimuth_deg(-pair.phi_r));
    return angles;
}

double separation_deg(const DirectionPair &pair) {
    const double cosine = glm::dot(pair.to_light(), pair.to_viewer());
    return std::acos(std::clamp(cosine, -1.0, 1.0)) / kDegree;
}

AxisAngles positions_deg(const RigFile &rig, const DirectionPair &pair, const AxisAngles &from) {
    Problems problems;
    const double apart = separation_deg(pair);
    problems.need(apart >= rig.dead_cone_deg,
                  "lamp and camera would be " + number_text(apart) + " degrees apart",
                  "geometry.dead_cone_deg",
                  "at least " + number_text(rig.dead_cone_deg) + " degrees");
    AxisAngles positions = axis_angles_deg(pair);
    for (std::size_t i = 0; i < kAxes; ++i) {
        const auto name = static_cast<AxisName>(i);
        const RigAxis &axis = rig.axes[i];
        const auto reachable = reachable_deg(axis, name, positions[i], from[i]);
        problems.need(reachable.has_value(),
                      "the drive does not reach " + number_text(axis.position_deg(positions[i])) +
                          " degrees",
                      std::string("axes.") + name_of(name),
                      number_text(axis.limits_deg[0]) + " to " + number_text(axis.limits_deg[1]));
        positions[i] = reachable.value_or(positions[i]);
    }
    problems.throw_if_any();
    return positions;
}

} // namespace tsuya::lab

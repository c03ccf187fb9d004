#pragma once
// A session that is measured in a moment, for tests of single corrections.

#include <algorithm>
#include <cmath>

#include "lab/virtual_session.h"
#include "tsuya/lab/measure_session.h"

namespace tsuya::test {

/// A cloth that is darker towards the horizon, under two lights.
inline VirtualSession small_session() {
    VirtualSession session;
    session.directions.symmetry = Symmetry::half_turn;
    for (const double theta_i : {0.0, 30.0})
        for (const double theta_r : {10.0, 20.0, 40.0, 60.0, 70.0})
            for (const double phi_r : {0.0, 40.0, 120.0})
                session.directions.pairs.push_back(
                    {theta_i * kDegree, 0.2 * (theta_i > 0), theta_r * kDegree, phi_r * kDegree});
    session.scene = {.cloth = [](const DirectionPair &d) { return 0.05 * std::cos(d.theta_r); },
                     .flicker = 0};
    session.white_every = 7;
    return session;
}

/// Largest relative error.
inline double worst_of(const lab::ChannelMeasurement &channel, const VirtualSession &session) {
    double worst = 0;
    for (const lab::MeasuredView &view : channel.views)
        worst =
            std::max(worst, std::abs(view.brdf_per_sr / session.scene.cloth(view.directions) - 1));
    return worst;
}

} // namespace tsuya::test

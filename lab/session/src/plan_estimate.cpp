#include "tsuya/lab/planning.h"
#include "tsuya/lab/rig_motion.h"

#include <algorithm>

namespace tsuya::lab {
namespace {

Seconds frame_time(const RigFile &rig, double exposure_s) {
    const Seconds lag = rig.shutter.lag; // a camera with a command waits for the blades to open
    const Seconds open = Seconds(exposure_s) + (rig.camera.command.empty() ? Seconds(0) : lag);
    return std::max(
        {rig.shutter.min_interval, open / rig.shutter.max_duty, open + lag + rig.camera.transfer});
}

} // namespace

PlanEstimate estimate(const Plan &plan, const RigFile &rig) {
    PlanEstimate sum{.frames = plan.frames.size(), .time = rig.lamp.warm_up};
    sum.disk_mb = static_cast<double>(sum.frames) * rig.camera.frame_mb;
    AxisAngles at{};
    FrameKind sample = FrameKind::dark;
    for (const PlannedFrame &frame : plan.frames) {
        sum.time += frame_time(rig, frame.exposure_s);
        if (frame.view < sum.views)
            continue;
        sum.views = frame.view + 1;
        const AxisAngles to = positions_deg(rig, frame.directions, at);
        for (std::size_t i = 0; i < kAxes; ++i)
            if (std::abs(to[i] - at[i]) > rig.axes[i].tolerance_deg) {
                ++sum.moves[i];
                sum.time += rig.axes[i].move + rig.axes[i].settle;
            }
        at = to;
        if (frame.kind != FrameKind::dark && frame.kind != sample) {
            ++sum.sample_changes;
            sum.time += rig.sample.change;
            sample = frame.kind;
        }
    }
    return sum;
}

} // namespace tsuya::lab

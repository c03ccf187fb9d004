#include "tsuya/lab/pulse_job.h"

#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

#include <optional>

namespace tsuya::lab {

PulseReport run_pulse_job(const PulseJob &job, const Progress &progress) {
    check_pulse_train(job.train);
    if (job.lamp.line == job.shutter.line && job.lamp.chip == job.shutter.chip)
        throw Error({.what = "lamp and shutter are the same line '" + job.lamp.line + "'",
                     .where = "lamp",
                     .accepted = "another line, or none"});
    if (job.simulate) {
        VirtualClock clock;
        SimulatedLine shutter(job.shutter.line, clock);
        SimulatedLine lamp(job.lamp.line, clock);
        const bool has_lamp = !job.lamp.line.empty();
        return run_pulses(job.train,
                          {.shutter = shutter, .clock = clock, .lamp = has_lamp ? &lamp : nullptr},
                          progress);
    }
    SteadyClock clock;
    GpioLine shutter(job.shutter);
    std::optional<GpioLine> lamp;
    if (!job.lamp.line.empty())
        lamp.emplace(job.lamp);
    return run_pulses(
        job.train, {.shutter = shutter, .clock = clock, .lamp = lamp ? &*lamp : nullptr}, progress);
}

} // namespace tsuya::lab

#include "tsuya/lab/pulse_job.h"

#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

#include <optional>

namespace tsuya::lab {
namespace {

void check_lines(const PulseJob &job) {
    Problems problems;
    const std::string accepted = "a line's name or offset";
    problems.need(!job.shutter.line.empty(), "the line has an empty name", "shutter", accepted);
    if (job.lamp) {
        problems.need(!job.lamp->line.empty(), "the line has an empty name", "lamp",
                      accepted + "; no lamp at all is possible, too");
        problems.need(job.lamp->line != job.shutter.line || job.lamp->chip != job.shutter.chip,
                      "lamp and shutter are the same line '" + job.shutter.line + "'", "lamp",
                      "another line, or none");
    }
    problems.throw_if_any();
}

} // namespace

PulseReport run_pulse_job(const PulseJob &job, const Progress &progress) {
    check_pulse_train(job.train);
    check_lines(job);
    if (job.simulate) {
        VirtualClock clock;
        SimulatedLine shutter(job.shutter.line, clock);
        SimulatedLine lamp(job.lamp ? job.lamp->line : "", clock);
        return run_pulses(job.train,
                          {.shutter = shutter, .clock = clock, .lamp = job.lamp ? &lamp : nullptr},
                          progress);
    }
    SteadyClock clock;
    GpioLine shutter(job.shutter);
    std::optional<GpioLine> lamp;
    if (job.lamp)
        lamp.emplace(*job.lamp);
    return run_pulses(
        job.train, {.shutter = shutter, .clock = clock, .lamp = lamp ? &*lamp : nullptr}, progress);
}

} // namespace tsuya::lab

#include "tsuya/lab/goniometer.h"
#include "tsuya/lab/pulse_job.h"
#include "tsuya/sdk/error.h"

#include <cstdio>

namespace {

/// Whether the goniometer is there: it refuses to measure nothing.
bool has_goniometer() {
    try {
        tsuya::lab::measure({}, {}, {});
    } catch (const tsuya::Error &) {
        return true;
    }
    return false;
}

} // namespace

int main() {
    const tsuya::lab::PulseReport report =
        tsuya::lab::run_pulse_job({.train = {.count = 5}, .simulate = true});
    std::printf("%zu pulses\n", report.pulses.size());
    return has_goniometer() && report.pulses.size() == 5 &&
                   tsuya::lab::gpio_lines().size() < 1'000'000
               ? 0
               : 1;
}

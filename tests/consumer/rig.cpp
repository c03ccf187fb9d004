#include "tsuya/lab/pulse_job.h"

#include <cstdio>

int main() {
    const tsuya::lab::PulseReport report =
        tsuya::lab::run_pulse_job({.train = {.count = 5}, .simulate = true});
    std::printf("%zu pulses\n", report.pulses.size());
    return report.pulses.size() == 5 && tsuya::lab::gpio_lines().lines.size() < 1'000'000 ? 0 : 1;
}

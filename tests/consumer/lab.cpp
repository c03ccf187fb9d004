#include "tsuya/lab/pulse_job.h"
#include "tsuya/lab/weave.h"

#include <cstdio>

int main() {
    const tsuya::lab::PulseReport report =
        tsuya::lab::run_pulse_job({.train = {.count = 5}, .simulate = true});
    const std::size_t weaves = tsuya::lab::weave_names().size();
    std::printf("%zu pulses, %zu weaves\n", report.pulses.size(), weaves);
    return report.pulses.size() == 5 && weaves > 0 ? 0 : 1;
}

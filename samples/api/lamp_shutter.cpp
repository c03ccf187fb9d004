// Lamp and shutter in virtual time: what a rig would do, without one.

#include <cstdio>

#include "tsuya/lab/pulse.h"
#include "tsuya/lab/simulated_line.h"
#include "tsuya/sdk/error.h"

namespace {

using namespace tsuya::lab;

void print(const SimulatedLine &line) {
    for (const Transition &t : line.transitions())
        std::printf("%9.3f ms  %-7s %s\n", static_cast<double>(t.time.count()) * 1e-6,
                    line.name().c_str(), t.active ? "on" : "off");
}

// [doc:pulses]
/// Five exposures of 20 ms under a lamp that was lit 2 s before. GpioLine and SteadyClock in the
/// place of the simulated ones drive a rig.
bool expose() {
    VirtualClock clock;
    SimulatedLine shutter("shutter", clock), lamp("lamp", clock);
    const PulseTrain train{.width = std::chrono::milliseconds(20),
                           .period = std::chrono::milliseconds(200),
                           .count = 5,
                           .warm_up = std::chrono::seconds(2)};
    const PulseReport report = run_pulses(train, {shutter, clock, &lamp});
    print(lamp);
    print(shutter);
    std::printf("%zu pulses of %.3f ms\n", report.pulses.size(),
                static_cast<double>(report.mean_width.count()) * 1e-6);
    return !shutter.active() && !lamp.active();
}
// [/doc:pulses]

} // namespace

int main() {
    try {
        return expose() ? 0 : 1;
    } catch (const tsuya::Error &error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}

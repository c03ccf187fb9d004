#include "tsuya/lab/mechanics.h"

namespace tsuya::lab {
namespace {

void let_pass(Clock &clock, Seconds time) {
    static_cast<void>(clock.sleep_until(
        clock.now() + std::chrono::round<std::chrono::nanoseconds>(time), nullptr));
}

} // namespace

void SimulatedMechanics::move(AxisName axis, double) { let_pass(clock_, rig_.axis(axis).move); }

void SimulatedMechanics::place(FrameKind) { let_pass(clock_, rig_.sample.change); }

} // namespace tsuya::lab

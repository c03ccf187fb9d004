#include "tsuya/lab/measure_session.h"
#include "tsuya/lab/virtual_camera.h"

#include <cstdio>

int main() {
    const tsuya::lab::VirtualCamera camera(
        {.cloth = [](const tsuya::DirectionPair &) { return 0.02; }}, {});
    const double light = camera.dn_per_s({.exposure_s = 1}, 0);
    std::printf("%.0f DN/s, %s\n", light, name_of(tsuya::lab::LeftOutReason::saturated));
    return light > 0 ? 0 : 1;
}

#include "tsuya/sdk/brdf.h"

#include <cstdio>

int main() {
    const tsuya::GgxBrdf facets({.alpha_weft = 0.4, .alpha_warp = 0.1, .f0 = 0.05});
    const float rho = facets.evaluate({0, 0, 1}, {0, 0, 1});
    std::printf("%.3f 1/sr from straight above\n", static_cast<double>(rho));
    return rho > 0.05f && rho < 1 ? 0 : 1; // f0 / (4 pi alpha alpha) = 0.099
}

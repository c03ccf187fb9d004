#include "tsuya/sdk/spectral_basis.h"

#include <cstdio>

int main() {
    const tsuya::Spectrum ramp{.wavelength_nm = {400, 700}, .value = {0, 1}};
    const std::vector<float> channels = tsuya::project(ramp, {.count = 8});
    std::printf("%zu channels, the last %.3f\n", channels.size(), channels.back());
    return channels.size() == 8 && channels.front() < channels.back() ? 0 : 1;
}

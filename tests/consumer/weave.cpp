#include "tsuya/lab/goniometer.h"
#include "tsuya/sdk/error.h"

#include <cstdio>

int main() {
    try {
        tsuya::lab::measure({}, {}, {}); // no cloth, no light
    } catch (const tsuya::Error &error) {
        std::printf("%s\n", error.what());
        return 0;
    }
    return 1;
}

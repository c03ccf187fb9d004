#include "tsuya/sdk/detail/spline.h"

#include <vector>

namespace tsuya {
namespace {

constexpr int kSweeps = 24; // each leaves half of the error or less

double beyond(SplineEnd end, double before, double second, double third, double opposite) {
    switch (end) {
    case SplineEnd::mirrored:
        return second;
    case SplineEnd::round:
        return opposite;
    case SplineEnd::smooth:
        return 3 * before - 3 * second + third;
    }
    return before;
}

} // namespace

// (below + 6 at + above) / 8 is the value at a node: solved from one end to the other until the
// coefficients stay.
void make_spline(std::span<double> c, SplineEnd first, SplineEnd last) {
    const std::size_t n = c.size() - 2; // nodes, from 1
    const std::vector<double> value(c.begin(), c.end());
    const auto set_ends = [&] {
        c[0] = beyond(first, c[1], c[2], c[3], c[n - 1]);
        c[n + 1] = beyond(last, c[n], c[n - 1], c[n - 2], c[2]);
    };
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
        set_ends();
        for (std::size_t i = 1; i <= n; ++i)
            c[i] = (8 * value[i] - c[i - 1] - c[i + 1]) / 6;
    }
    set_ends();
}

} // namespace tsuya

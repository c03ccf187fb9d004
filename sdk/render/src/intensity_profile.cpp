#include "tsuya/sdk/intensity_profile.h"

#include <algorithm>
#include <cmath>

#include "tsuya/sdk/angle.h"

namespace tsuya {
namespace {

// Where a value lies between those of a rising list that holds it.
struct Between {
    std::size_t first, second;
    double share; // of the second
};

Between between(const std::vector<double> &list, double value) {
    if (list.size() == 1 || value <= list.front())
        return {0, 0, 0};
    if (value >= list.back())
        return {list.size() - 1, list.size() - 1, 0};
    const auto after = std::upper_bound(list.begin(), list.end(), value);
    const auto second = static_cast<std::size_t>(after - list.begin());
    return {second - 1, second, (value - list[second - 1]) / (list[second] - list[second - 1])};
}

// An angle about the axis as one of those that are known.
double folded(double angle, double last) {
    angle -= 2 * kPi * std::floor(angle / (2 * kPi));
    if (last > 1.5 * kPi)
        return angle;
    if (angle > kPi)
        angle = 2 * kPi - angle;
    return last < 0.75 * kPi && angle > kHalfPi ? kPi - angle : angle;
}

} // namespace

double IntensityProfile::at(double vertical_angle, double horizontal_angle) const {
    constexpr double kRounding = 1e-6;
    if (vertical_angle < vertical.front() - kRounding ||
        vertical_angle > vertical.back() + kRounding)
        return 0;
    const Between v = between(vertical, vertical_angle);
    const Between h = between(horizontal, folded(horizontal_angle, horizontal.back()));
    const auto along = [&](std::size_t row) {
        const double *const values = candela.data() + row * vertical.size();
        return values[v.first] + v.share * (values[v.second] - values[v.first]);
    };
    const double first = along(h.first);
    return h.share > 0 ? first + h.share * (along(h.second) - first) : first;
}

double IntensityProfile::highest() const {
    return *std::max_element(candela.begin(), candela.end());
}

double IntensityProfile::last_angle() const {
    std::size_t last = 0;
    for (std::size_t i = 0; i < candela.size(); ++i)
        if (candela[i] > 0)
            last = std::max(last, i % vertical.size());
    return vertical[std::min(last + 1, vertical.size() - 1)];
}

} // namespace tsuya

#include "tsuya/lab/lamp_drift.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tsuya::lab {
namespace {

/// Readings that stand about a time.
struct Between {
    const WhiteReading &before, &after;
    double part = 0; ///< of the way from one to the other

    double rate() const { return std::lerp(before.rate, after.rate, part); }
    double noise_variance() const {
        const double a = (1 - part) * before.sigma, b = part * after.sigma;
        return a * a + b * b;
    }
    /// How much of a single frame's flicker is in the line between the two.
    double flicker_share() const { return (1 - part) * (1 - part) + part * part; }
};

double part_of_way(const WhiteReading &before, const WhiteReading &after, double time_s) {
    const double way = after.time_s - before.time_s;
    return way > 0 ? std::clamp((time_s - before.time_s) / way, 0.0, 1.0) : 0.0;
}

void sort_readings(std::vector<WhiteReading> &readings) {
    std::sort(readings.begin(), readings.end(), [](const auto &a, const auto &b) {
        return std::tie(a.strike, a.time_s) < std::tie(b.strike, b.time_s);
    });
}

} // namespace

LampDrift::LampDrift(std::vector<WhiteReading> readings, double jump_limit, double flicker)
    : readings_(std::move(readings)), jump_limit_(jump_limit), flicker_(flicker) {
    sort_readings(readings_);
}

std::optional<LampLight> LampDrift::at(double time_s, int strike) const {
    const auto [first, last] =
        std::equal_range(readings_.begin(), readings_.end(), WhiteReading{.strike = strike},
                         [](const auto &a, const auto &b) { return a.strike < b.strike; });
    if (first == last)
        return std::nullopt;
    const auto next = std::find_if(first, last, [&](const auto &r) { return r.time_s >= time_s; });
    const auto before = next == first ? first : next - 1, after = next == last ? before : next;
    const Between lamp{*before, *after, part_of_way(*before, *after, time_s)};
    const double flicker = flicker_ * lamp.rate();
    return LampLight{
        .rate = lamp.rate(),
        .sigma = std::sqrt(lamp.noise_variance() + flicker * flicker * (1 + lamp.flicker_share())),
        .jump = std::abs(after->rate - before->rate) > jump_limit_ * before->rate};
}

std::optional<double> flicker_of(const std::vector<std::vector<WhiteReading>> &lists) {
    double sum = 0;
    int count = 0;
    for (std::vector<WhiteReading> readings : lists) {
        sort_readings(readings);
        for (std::size_t i = 1; i + 1 < readings.size(); ++i) {
            const WhiteReading &a = readings[i - 1], &b = readings[i], &c = readings[i + 1];
            if (a.strike != c.strike)
                continue;
            const Between line{a, c, part_of_way(a, c, b.time_s)};
            const double rate = line.rate(), off = b.rate - rate;
            const double noise = line.noise_variance() + b.sigma * b.sigma;
            sum += (off * off - noise) / (1 + line.flicker_share()) / (rate * rate);
            ++count;
        }
    }
    if (count == 0)
        return std::nullopt;
    return std::sqrt(std::max(sum / count, 0.0));
}

} // namespace tsuya::lab

#include "sdk/hemisphere_quadrature.h"
#include "tsuya/sdk/angle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>

namespace tsuya::test {
namespace {

constexpr double kLeastExpected = 5;

// A rectangle of theta and phi with the midpoint sum of its four quarters.
struct Cell {
    double theta, theta_step, phi, phi_step;
    int bin;
    double value = 0, spread = 0;
    bool operator<(const Cell &other) const { return spread < other.spread; }
};

void measure(Cell &cell, const std::function<double(const glm::vec3 &)> &function) {
    std::array<double, 4> f{};
    const double share = cell.theta_step * cell.phi_step / 4;
    cell.value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const double t = cell.theta + cell.theta_step * (i & 1 ? 0.75 : 0.25);
        const double p = cell.phi + cell.phi_step * (i & 2 ? 0.75 : 0.25);
        const double s = std::sin(t);
        f[i] = function(glm::vec3(s * std::cos(p), s * std::sin(p), std::cos(t))) * s;
        cell.value += f[i] * share;
    }
    const auto [low, high] = std::minmax_element(f.begin(), f.end());
    cell.spread = (*high - *low) * 4 * share;
}

} // namespace

int HemisphereBins::bin_of(const glm::vec3 &d) const {
    const double theta = std::atan2(std::hypot(d.x, d.y), d.z);
    double phi = std::atan2(d.y, d.x);
    if (phi < 0)
        phi += 2 * kPi;
    const int i = std::clamp(static_cast<int>(theta / (kPi / 2) * thetas), 0, thetas - 1);
    const int j = std::clamp(static_cast<int>(phi / (2 * kPi) * phis), 0, phis - 1);
    return i * phis + j;
}

std::vector<double> integrate_bins(const std::function<double(const glm::vec3 &)> &function,
                                   const HemisphereBins &bins, int evaluations) {
    constexpr int kFirstCells = 4; // along each side of a bin
    std::priority_queue<Cell> cells;
    std::vector<double> result(static_cast<std::size_t>(bins.count()));
    const auto add = [&](Cell cell) {
        measure(cell, function);
        result[static_cast<std::size_t>(cell.bin)] += cell.value;
        cells.push(cell);
        evaluations -= 4;
    };
    const double theta_step = kPi / 2 / (bins.thetas * kFirstCells);
    const double phi_step = 2 * kPi / (bins.phis * kFirstCells);
    for (int i = 0; i < bins.thetas * kFirstCells; ++i)
        for (int j = 0; j < bins.phis * kFirstCells; ++j)
            add({i * theta_step, theta_step, j * phi_step, phi_step,
                 i / kFirstCells * bins.phis + j / kFirstCells});
    while (evaluations > 0 && cells.top().spread > 0) {
        const Cell c = cells.top();
        cells.pop();
        result[static_cast<std::size_t>(c.bin)] -= c.value;
        const double t = c.theta_step / 2, p = c.phi_step / 2;
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                add({c.theta + i * t, t, c.phi + j * p, p, c.bin});
    }
    return result;
}

double integrate(const std::function<double(const glm::vec3 &)> &function, int evaluations) {
    const auto bins = integrate_bins(function, {}, evaluations);
    return std::accumulate(bins.begin(), bins.end(), 0.0);
}

double chi_square_tail(double chi_square, int degrees_of_freedom) {
    // The cube root of chi-square over its mean is nearly normal (Wilson and Hilferty 1931)
    const double variance = 2.0 / (9.0 * degrees_of_freedom);
    const double z =
        (std::cbrt(chi_square / degrees_of_freedom) - (1 - variance)) / std::sqrt(variance);
    return 0.5 * std::erfc(z / std::numbers::sqrt2);
}

double chi_square_p_value(const std::vector<double> &observed,
                          const std::vector<double> &expected) {
    std::vector<std::size_t> order(expected.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return expected[a] < expected[b]; });
    double chi_square = 0, pooled_observed = 0, pooled_expected = 0;
    int used = 0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        pooled_observed += observed[order[i]];
        pooled_expected += std::max(0.0, expected[order[i]]);
        if (pooled_expected < kLeastExpected && i + 1 < order.size())
            continue;
        // One event is allowed where nothing at all is expected: the rounding of the integrals
        const double difference = pooled_observed - pooled_expected;
        chi_square += difference * difference / std::max(pooled_expected, 1.0);
        ++used;
        pooled_observed = pooled_expected = 0;
    }
    return used > 1 ? chi_square_tail(chi_square, used - 1) : 0;
}

double sidak_threshold(int tests) { return 1 - std::pow(0.99, 1.0 / tests); }

glm::vec3 Random::direction() {
    const float z = number(), phi = 2 * static_cast<float>(kPi) * number();
    const float s = std::sqrt(1 - z * z);
    return {s * std::cos(phi), s * std::sin(phi), z};
}

} // namespace tsuya::test

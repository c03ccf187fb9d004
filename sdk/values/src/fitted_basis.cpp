#include "fitted_basis.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <mutex>

#include <Eigen/Dense>

#include "reflectance_covariance.h"

namespace tsuya {
namespace {

// Wavelengths of 16 channels, found by moving one after the other for the least CIEDE2000 of random
// dyes under six lamps; other numbers of channels share the spectrum in the same proportions.
constexpr std::array<double, 16> kNodes{418, 436, 447, 464, 487, 511, 531, 544,
                                        559, 576, 594, 613, 633, 650, 663, 699};

// A window is a triangle whose half width is this share of the mean distance to the neighbours: as
// narrow as that products of channels are products of spectra, as wide as that a steep edge is not
// missed.
constexpr double kHalfWidth = 0.6;

// The triangle as points of equal distance.
constexpr int kSteps = 8;
constexpr std::size_t kPoints = 2 * kSteps - 1;

struct WindowPoint {
    double nm, weight;
};

std::array<WindowPoint, kPoints> window(const SpectralBasis &basis, int channel) {
    const std::vector<double> &nodes = basis.node_nm;
    const int last = basis.count - 1;
    const int before = std::max(channel - 1, 0), after = std::min(channel + 1, last);
    const double gap =
        (nodes[static_cast<std::size_t>(after)] - nodes[static_cast<std::size_t>(before)]) /
        std::max(1, after - before);
    std::array<WindowPoint, kPoints> points{};
    for (int i = 1 - kSteps; i < kSteps; ++i)
        points[static_cast<std::size_t>(i + kSteps - 1)] = {
            basis.centre_nm(channel) + kHalfWidth * gap * i / kSteps,
            (1 - std::abs(i) / double{kSteps}) / kSteps};
    return points;
}

// [Cressie] section 3.2: the weights of a known mean, and what they lack of 1 by the shares that
// the channels have in the best estimate of the mean.
std::vector<double> predicted(const SpectralBasis &basis) {
    const int count = basis.count, rows = kFittedLastNm - kFittedFirstNm + 1;
    // Constant beyond a gap from the outermost: a prediction from afar swings
    const std::vector<double> &nodes = basis.node_nm;
    const double lowest = nodes[0] - (nodes[1] - nodes[0]);
    const double highest = nodes.back() + (nodes.back() - nodes[nodes.size() - 2]);
    Eigen::MatrixXd with_channels(rows, count), of_channels(count, count);
    for (int k = 0; k < count; ++k) {
        const auto points = window(basis, k);
        const auto covariance = [&](double nm) {
            double sum = 0;
            for (const WindowPoint &point : points)
                sum += point.weight * reflectance_covariance(nm, point.nm);
            return sum;
        };
        for (int row = 0; row < rows; ++row)
            with_channels(row, k) =
                covariance(std::clamp<double>(kFittedFirstNm + row, lowest, highest));
        for (int j = 0; j < count; ++j) {
            of_channels(j, k) = 0;
            for (const WindowPoint &point : window(basis, j))
                of_channels(j, k) += point.weight * covariance(point.nm);
        }
    }
    const Eigen::MatrixXd inverse = of_channels.inverse();
    const Eigen::RowVectorXd mean_share = inverse.colwise().sum() / inverse.sum();
    Eigen::MatrixXd weights = with_channels * inverse;
    const Eigen::VectorXd lacking = 1 - weights.rowwise().sum().array();
    weights += lacking * mean_share;
    std::vector<double> by_nm;
    for (int row = 0; row < rows; ++row)
        for (int k = 0; k < count; ++k)
            by_nm.push_back(weights(row, k));
    return by_nm;
}

} // namespace

std::vector<double> fitted_nodes(int count) {
    const auto most = static_cast<double>(kNodes.size() - 1);
    std::vector<double> nodes;
    for (int k = 0; k < count; ++k) {
        // Linear in the number of the node, also beyond the first and the last
        const double place = (k + 0.5) / count * static_cast<double>(kNodes.size()) - 0.5;
        const auto below = static_cast<std::size_t>(std::clamp(place, 0.0, most - 1));
        const double t = place - static_cast<double>(below);
        nodes.push_back(std::round((1 - t) * kNodes[below] + t * kNodes[below + 1]));
    }
    return nodes;
}

// Kept for the process: they take 2.5 ms for 16 channels and 9 ms for 32, of the 17 ms of a picture
// of a million pixels under one more lamp.
std::shared_ptr<const std::vector<double>> fitted_weights(const SpectralBasis &basis) {
    static std::mutex mutex;
    static std::map<std::vector<double>, std::shared_ptr<const std::vector<double>>> made;
    const std::lock_guard lock(mutex);
    auto &weights = made[basis.node_nm];
    if (!weights)
        weights = std::make_shared<const std::vector<double>>(predicted(basis));
    return weights;
}

double window_mean(const Spectrum &spectrum, const SpectralBasis &basis, int channel) {
    double mean = 0;
    for (const WindowPoint &point : window(basis, channel))
        mean += point.weight * spectrum.at(point.nm);
    return mean;
}

} // namespace tsuya

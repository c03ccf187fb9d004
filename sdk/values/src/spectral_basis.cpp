#include "tsuya/sdk/spectral_basis.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Dense>

#include "fitted_basis.h"

namespace tsuya {
namespace {

std::vector<float> least_squares(const Spectrum &spectrum, const SpectralBasis &basis) {
    const auto samples = static_cast<Eigen::Index>(std::lround(basis.last_nm - basis.first_nm)) + 1;
    Eigen::MatrixXd hats(samples, basis.count);
    Eigen::VectorXd values(samples);
    const BasisWeights weights(basis);
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double nm = basis.first_nm + static_cast<double>(i);
        values[i] = spectrum.at(nm);
        const std::vector<double> row = weights.at_nm(nm);
        hats.row(i) = Eigen::Map<const Eigen::RowVectorXd>(row.data(), basis.count);
    }
    const Eigen::VectorXd fit = (hats.transpose() * hats).ldlt().solve(hats.transpose() * values);
    std::vector<float> channels;
    for (const double value : fit)
        channels.push_back(static_cast<float>(std::max(0.0, value)));
    return channels;
}

} // namespace

SpectralBasis SpectralBasis::of_renders(int count) {
    SpectralBasis basis = samples_at(fitted_nodes(count));
    basis.kind = BasisKind::fitted;
    return basis;
}

SpectralBasis SpectralBasis::samples_at(std::vector<double> node_nm) {
    SpectralBasis basis{.count = static_cast<int>(node_nm.size()), .kind = BasisKind::samples};
    basis.node_nm = std::move(node_nm);
    return basis;
}

double SpectralBasis::centre_nm(int channel) const {
    if (kind != BasisKind::hats)
        return node_nm[static_cast<std::size_t>(channel)];
    return count < 2 ? 0.5 * (first_nm + last_nm)
                     : first_nm + (last_nm - first_nm) * channel / (count - 1);
}

bool SpectralBasis::is_valid() const {
    if (count < (kind == BasisKind::fitted ? 2 : 1))
        return false;
    if (kind == BasisKind::hats)
        return std::isfinite(first_nm) && std::isfinite(last_nm) && first_nm < last_nm;
    return node_nm.size() == static_cast<std::size_t>(count) &&
           std::all_of(node_nm.begin(), node_nm.end(),
                       [](double nm) { return std::isfinite(nm); }) &&
           std::is_sorted(node_nm.begin(), node_nm.end(), std::less_equal<>());
}

BasisWeights::BasisWeights(SpectralBasis basis) : basis_(std::move(basis)) {
    if (basis_.kind == BasisKind::fitted)
        fitted_ = fitted_weights(basis_);
}

std::vector<double> BasisWeights::at_nm(double nm) const {
    const auto count = static_cast<std::size_t>(basis_.count);
    std::vector<double> weights(count);
    if (fitted_) {
        const std::vector<double> &fitted = *fitted_;
        const double place = std::clamp<double>(nm, kFittedFirstNm, kFittedLastNm) - kFittedFirstNm;
        const auto row = std::min(static_cast<std::size_t>(place), fitted.size() / count - 2);
        const double t = place - static_cast<double>(row);
        for (std::size_t k = 0; k < count; ++k)
            weights[k] = (1 - t) * fitted[row * count + k] + t * fitted[(row + 1) * count + k];
        return weights;
    }
    if (count < 2)
        return {1.0};
    int above = 1;
    while (above + 1 < basis_.count && basis_.centre_nm(above) < nm)
        ++above;
    const double low = basis_.centre_nm(above - 1), high = basis_.centre_nm(above);
    const double t = std::clamp((nm - low) / (high - low), 0.0, 1.0);
    weights[static_cast<std::size_t>(above) - 1] = 1 - t;
    weights[static_cast<std::size_t>(above)] = t;
    return weights;
}

std::vector<float> project(const Spectrum &spectrum, const SpectralBasis &basis) {
    if (spectrum.is_constant())
        return std::vector<float>(static_cast<std::size_t>(basis.count),
                                  static_cast<float>(spectrum.value[0]));
    if (basis.kind == BasisKind::hats)
        return least_squares(spectrum, basis);
    std::vector<float> channels;
    for (int k = 0; k < basis.count; ++k)
        channels.push_back(static_cast<float>(basis.kind == BasisKind::fitted
                                                  ? window_mean(spectrum, basis, k)
                                                  : spectrum.at(basis.centre_nm(k))));
    return channels;
}

} // namespace tsuya

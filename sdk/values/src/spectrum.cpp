#include "tsuya/sdk/spectrum.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "tsuya/sdk/detail/counted.h"
#include "tsuya/sdk/error.h"

namespace tsuya {

bool Spectrum::is_constant() const {
    return std::all_of(value.begin(), value.end(), [&](double v) { return v == value.front(); });
}

bool Spectrum::any_above_zero() const {
    return std::any_of(value.begin(), value.end(), [](double v) { return v > 0; });
}

double Spectrum::at(double nm) const {
    const auto upper = std::upper_bound(wavelength_nm.begin(), wavelength_nm.end(), nm);
    if (upper == wavelength_nm.begin())
        return value.front();
    if (upper == wavelength_nm.end())
        return value.back();
    const auto i = static_cast<std::size_t>(upper - wavelength_nm.begin());
    const double t = (nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
    return (1 - t) * value[i - 1] + t * value[i];
}

void check_spectrum(const Spectrum &s, double low, double high, const std::string &where) {
    if (s.value.empty() || s.value.size() != s.wavelength_nm.size())
        throw Error({"the spectrum has " + detail::counted(s.wavelength_nm.size(), "wavelength") +
                         " and " + detail::counted(s.value.size(), "value"),
                     where, "expected as many values as wavelengths, at least one"});
    for (std::size_t i = 0; i < s.value.size(); ++i) {
        const std::string at = std::to_string(s.wavelength_nm[i]) + " nm";
        if (!std::isfinite(s.wavelength_nm[i]) ||
            (i > 0 && s.wavelength_nm[i] <= s.wavelength_nm[i - 1]))
            throw Error({"the wavelengths do not increase at " + at, where,
                         "expected strictly increasing wavelengths in nm"});
        if (!(s.value[i] >= low && s.value[i] <= high))
            throw Error(
                {"the value at " + at + " is " + std::to_string(s.value[i]), where,
                 "expected a number from " + std::to_string(low) + " to " + std::to_string(high)});
    }
}

double SpectralBasis::centre_nm(int channel) const {
    return count < 2 ? 0.5 * (first_nm + last_nm)
                     : first_nm + (last_nm - first_nm) * channel / (count - 1);
}

double SpectralBasis::weight(int channel, double nm) const {
    if (count < 2)
        return 1.0;
    const double position =
        std::clamp((nm - first_nm) / (last_nm - first_nm), 0.0, 1.0) * (count - 1);
    return std::max(0.0, 1.0 - std::abs(position - channel));
}

std::vector<float> project(const Spectrum &spectrum, const SpectralBasis &basis) {
    std::vector<float> coefficients(static_cast<std::size_t>(basis.count));
    if (spectrum.is_constant()) {
        std::fill(coefficients.begin(), coefficients.end(), static_cast<float>(spectrum.value[0]));
        return coefficients;
    }
    const auto samples = static_cast<Eigen::Index>(std::lround(basis.last_nm - basis.first_nm)) + 1;
    Eigen::MatrixXd hats(samples, basis.count);
    Eigen::VectorXd values(samples);
    for (Eigen::Index i = 0; i < samples; ++i) {
        const double nm = basis.first_nm + static_cast<double>(i);
        values[i] = spectrum.at(nm);
        for (int k = 0; k < basis.count; ++k)
            hats(i, k) = basis.weight(k, nm);
    }
    const Eigen::VectorXd fit = (hats.transpose() * hats).ldlt().solve(hats.transpose() * values);
    for (int k = 0; k < basis.count; ++k)
        coefficients[static_cast<std::size_t>(k)] = static_cast<float>(std::max(0.0, fit[k]));
    return coefficients;
}

} // namespace tsuya

#include "tsuya/sdk/spectrum.h"

#include <algorithm>
#include <cmath>

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

} // namespace tsuya

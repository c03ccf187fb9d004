#pragma once
/// \file
/// A quantity over wavelength, and its projection on the K channels that a render carries.

#include <string>
#include <vector>

namespace tsuya {

/// A quantity over wavelength: linear between samples, constant beyond the first and the last.
/// One sample is a constant. Reflectances are 0..1; lamps are relative spectral power.
struct Spectrum {
    std::vector<double> wavelength_nm{560.0}; ///< strictly increasing
    std::vector<double> value{0.0};           ///< as many as wavelengths

    /// The same value at every wavelength.
    static Spectrum constant(double value) { return {{560.0}, {value}}; }
    bool operator==(const Spectrum &) const = default;
    /// All samples have one value.
    bool is_constant() const;
    /// A sample is above 0.
    bool any_above_zero() const;
    /// Value at a wavelength in nm. O(log n).
    double at(double wavelength_nm) const;
};

/// Throws Error naming `where` if the samples are not a spectrum: lengths that differ, none, not
/// increasing, NaN or infinite, or a value outside [low, high].
void check_spectrum(const Spectrum &spectrum, double low, double high, const std::string &where);

/// K hat functions with equally spaced centres on [first_nm, last_nm]; the outermost are constant
/// beyond their centre. They sum to 1 at every wavelength.
struct SpectralBasis {
    int count = 16;
    double first_nm = 400.0;
    double last_nm = 700.0;

    /// Wavelength at which the function of a channel is 1; channels count from 0.
    double centre_nm(int channel) const;
    /// Value of a basis function at a wavelength, in [0, 1].
    double weight(int channel, double wavelength_nm) const;
    bool operator==(const SpectralBasis &) const = default;
};

/// The `count` coefficients of `spectrum` in the basis: least squares at 1 nm over the basis'
/// range, limited to not negative. A constant is reproduced exactly.
std::vector<float> project(const Spectrum &spectrum, const SpectralBasis &basis);

} // namespace tsuya

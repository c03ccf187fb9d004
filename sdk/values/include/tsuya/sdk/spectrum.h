#pragma once
/// \file
/// A quantity over wavelength.

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

} // namespace tsuya

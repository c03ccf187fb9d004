#pragma once
/// \file
/// Spectra in lines of fields.

#include <string>
#include <string_view>

#include "tsuya/color/spectrum_file.h"

namespace tsuya {

/// Reads decoded text, see read_spectrum_file. \param name of the file, for errors
SpectrumFile parse_spectral_text(std::string_view text, const std::string &name);

/// Wavelength in nm that a name such as `R400`, `SPECTRAL_NM400` or `400 nm` ends or begins with;
/// nothing where that is no wavelength from 100 to 4000 nm.
std::optional<double> wavelength_in_name(std::string_view name);

/// Letters and digits of a name, in lower case.
std::string plain_name(std::string_view name);

/// Turns a sample whose wavelengths fall around.
void sort_rising(SpectrumSample &sample);

/// Wavelength in the form that messages have, such as `589.5`.
std::string number_text(double value);

} // namespace tsuya

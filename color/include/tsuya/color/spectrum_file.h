#pragma once
/// \file
/// Spectra in CSV files: two columns, `wavelength_nm,value`.

#include <filesystem>
#include <limits>
#include <string>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Values that a spectrum may have.
struct ValueRange {
    double low = 0.0;
    double high = std::numeric_limits<double>::max();
};

/// Reads `wavelength_nm,value` lines. Lines that are empty or begin with `#` are skipped; the first
/// other line may be a header. Wavelengths are in nm, strictly increasing, greater than 0; values
/// lie in `range`. Throws Error with up to 20 problems at `file:line:column`, or one at `file`
/// where it cannot be read or holds no line.
Spectrum read_spectrum_csv(const std::filesystem::path &path, const ValueRange &range = {});

/// Writes a spectrum so that read_spectrum_csv gives the same numbers. `comment` becomes `#` lines.
/// Throws Error if the file cannot be written.
void write_spectrum_csv(const std::filesystem::path &path, const Spectrum &spectrum,
                        const std::string &comment = {});

} // namespace tsuya

#pragma once
/// \file
/// Lamps by name, and lamps of one's own. A lamp is relative spectral power, in any unit.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// Names that `lamp` knows: D65, D50, A, E, FL2, FL11, FL12, HP1 to HP5, LED-B3, MH-NIST.
std::vector<std::string> lamp_names();

/// Relative spectral power of a named lamp. A is Planck's formula at 1 nm from 360 to 830 nm, E is
/// constant; the others are tables at 5 nm from 380 to 780 nm, linear between the samples and, as
/// [CIE015] section 7.2.2.1 advises, constant beyond the last (which holds 0.1 % of Y at most).
/// Throws Error for an unknown name, with the known ones and the nearest.
Spectrum lamp(std::string_view name);

/// One line about a named lamp: kind and correlated colour temperature. Throws Error as `lamp`.
std::string lamp_description(std::string_view name);

/// A lamp with the name that it has in reports.
struct NamedLamp {
    std::string name{};
    Spectrum spectrum{};
    std::string caption{}; ///< what to write under a picture: `D65: daylight, 6504 K`
    /// What was mended or looks odd in its file, a sentence each.
    std::vector<std::string> warnings{};
};

/// A lamp as programs name it: a name of `lamp_names()`, or a file of spectra as
/// parse_spectrum_file_spec knows them, relative to `folder`. A file that does not name one of
/// several spectra has that of `sample`. The caption of a file is its name and its correlated
/// colour temperature. Throws Error as `lamp` and read_lamp_file.
NamedLamp find_lamp(const std::string &spec, const std::filesystem::path &folder = {},
                    const std::string &sample = {});

/// The spectrum of find_lamp.
Spectrum parse_lamp(const std::string &spec, const std::filesystem::path &folder = {});

/// Throws Error for a text that is neither of the two, whatever files there are.
void check_lamp_spec(const std::string &spec);

} // namespace tsuya

#pragma once
/// \file
/// Dyes: the diffuse reflectance of dyed silk over wavelength.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "tsuya/sdk/spectrum.h"

namespace tsuya {

/// The names that `dye` knows, from white over the colours to black.
std::vector<std::string> dye_names();

/// Reflectance (0..1) of a named dye on silk, at 5 nm from 360 to 830 nm. These are models of ours,
/// not measurements: the absorption of the dye is a sum of Gaussian bands and smooth edges, added
/// to that of the undyed cloth (0.80, a little less in the blue), and turned into reflectance by
/// the one-constant theory of [Kubelka]. Throws Error for an unknown name, with the known ones and
/// the nearest.
Spectrum dye(std::string_view name);

/// One line about a named dye. Throws Error as `dye`.
std::string dye_description(std::string_view name);

/// A dye with the name that it has in reports.
struct NamedDye {
    std::string name{};
    Spectrum spectrum{};
    /// What was mended or looks odd in its file, a sentence each.
    std::vector<std::string> warnings{};
};

/// A dye as programs name it: a name of `dye_names()`; a file of spectra as
/// parse_spectrum_file_spec knows them, relative to `folder`; or `#rrggbb`, see
/// reflectance_of_srgb. Throws Error as those and read_dye_file do, or at `where`.
NamedDye find_dye(const std::string &spec, const std::filesystem::path &folder = {},
                  const std::string &where = "dye");

/// The spectrum of find_dye.
Spectrum parse_dye(const std::string &spec, const std::filesystem::path &folder = {},
                   const std::string &where = "dye");

/// Throws Error at `where` for a text that is none of the three, whatever files there are.
void check_dye_spec(const std::string &spec, const std::string &where = "dye");

} // namespace tsuya

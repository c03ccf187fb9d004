#pragma once
/// \file
/// Dyes: the diffuse reflectance of dyed silk over wavelength.
///
/// | spec | is |
/// |---|---|
/// | `crimson` | a name of `dye_names()`, in any case |
/// | `#aa3344` | an sRGB colour, see reflectance_of_srgb |
/// | `lab(50 20 -30)` | CIELAB under D65 for the 10-degree observer, see reflectance_of_lab |
/// | `lab(50 20 -30 D50/2)` | the same under another lamp, for the 2-degree observer |
/// | `cloth.csv`, `range.cxf:navy` | a file of spectra, see read_dye_file |
/// | `indigo 2% + madder 0.5%` | a mixture, see mix_dyes |
/// | `cloth(#ffffff)` | any of these between the black and the white of cloth, see on_cloth |

#include <filesystem>
#include <span>
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

/// A dye in a bath.
struct DyeShare {
    Spectrum dye{};     ///< reflectance (0..1) of silk that is dyed with 1 %
    double percent = 1; ///< of the weight of the cloth
};

/// Reflectance of undyed silk (`white`) that is dyed with several dyes at once: each adds its K/S
/// above that of the undyed cloth in proportion to its percentage, by the one-constant theory of
/// [Kubelka]. Reflectances below 1e-4 count as that. Throws Error for none, a percentage outside
/// [0, 100] or a reflectance outside [0, 1].
Spectrum mix_dyes(std::span<const DyeShare> shares);

/// A reflectance that cloth can have: 0 becomes that of `black`, 1 that of `white`, linear between.
/// Greys stay as neutral as those two are. \param reflectance 0..1
Spectrum on_cloth(const Spectrum &reflectance);

/// A dye as programs name it, in one of the forms above. Files are relative to `folder`. In a
/// mixture the colour of each dye is that at 1 %. Throws Error as the functions named there, or at
/// `where`.
NamedDye find_dye(const std::string &spec, const std::filesystem::path &folder = {},
                  const std::string &where = "dye");

/// The spectrum of find_dye.
Spectrum parse_dye(const std::string &spec, const std::filesystem::path &folder = {},
                   const std::string &where = "dye");

/// Throws Error at `where` for a text that find_dye refuses whatever files there are.
void check_dye_spec(const std::string &spec, const std::string &where = "dye");

} // namespace tsuya
